// tests/io/sequence_folder.h: small sequences on disk for the reader's tests.
#pragma once

#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/frame.h"
#include "io/calibration_texts.h"
#include "io/images/image_codec.h"
#include "io/images/image_writer.h"
#include "io/temporary_folder.h"
#include "io/textures.h"

namespace softscope::test {

inline constexpr int kWidth = 160, kHeight = 120, kDisparity = 9;

inline std::string numbered(int index, const std::string& kind = ".png") {
  char name[32];
  std::snprintf(name, sizeof name, "%06d", index);
  return name + kind;
}

/// Frame `index` of every test sequence.
inline StereoPair testPair(int index) {
  return {makeTexture(kWidth, kHeight, 0, 100 + index),
          makeTexture(kWidth, kHeight, kDisparity, 100 + index)};
}

/// For the small pictures: f 150 px.
inline std::string smallCalibration(
    const std::string& size = "image_width: 160\nimage_height: 120\n") {
  const std::string camera = "150 0 80 0 150 60 0 0 1", none = "0 0 0 0 0";
  return "%YAML:1.0\n---\n" + size + "rectified: 1\n" + yamlMatrix("M1", 3, 3, camera) +
         yamlMatrix("D1", 1, 5, none) + yamlMatrix("M2", 3, 3, camera) +
         yamlMatrix("D2", 1, 5, none) + yamlMatrix("R", 3, 3, "1 0 0 0 1 0 0 0 1") +
         yamlMatrix("T", 3, 1, "-5 0 0");
}

/// left/, right/ and calibration.yaml.
inline void makeSequence(const std::filesystem::path& folder, int count) {
  put(folder / "calibration.yaml", smallCalibration());
  for (const char* side : {"left", "right"}) std::filesystem::create_directories(folder / side);
  for (int i = 0; i < count; ++i) {
    writePng(folder / "left" / numbered(i), testPair(i).left);
    writePng(folder / "right" / numbered(i), testPair(i).right);
  }
}

/// Motion JPEG at quality 95.
inline void makeVideo(const std::filesystem::path& file, const std::vector<ColourImage>& frames,
                      double rate_hz = 25) {
  cv::VideoWriter writer(file.string(), cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate_hz,
                         {frames[0].width_px, frames[0].height_px});
  for (const ColourImage& frame : frames) {
    cv::Mat bgr;
    cv::cvtColor(matrixView(frame, CV_8UC3), bgr, cv::COLOR_RGB2BGR);
    writer.write(bgr);
  }
}

inline ColourImage sideBySide(const StereoPair& pair) {
  ColourImage out(2 * pair.left.width_px, pair.left.height_px);
  for (int v = 0; v < out.height_px; ++v) {
    std::copy_n(pair.left.row(v), pair.left.width_px, out.row(v));
    std::copy_n(pair.right.row(v), pair.left.width_px, out.row(v) + pair.left.width_px);
  }
  return out;
}

inline ColourImage topBottom(const StereoPair& pair) {
  ColourImage out(pair.left.width_px, 2 * pair.left.height_px);
  for (int v = 0; v < pair.left.height_px; ++v) {
    std::copy_n(pair.left.row(v), out.width_px, out.row(v));
    std::copy_n(pair.right.row(v), out.width_px, out.row(v + pair.left.height_px));
  }
  return out;
}

inline ColourImage interlaced(const StereoPair& pair) {
  ColourImage out(pair.left.width_px, 2 * pair.left.height_px);
  for (int v = 0; v < pair.left.height_px; ++v) {
    std::copy_n(pair.left.row(v), out.width_px, out.row(2 * v));
    std::copy_n(pair.right.row(v), out.width_px, out.row(2 * v + 1));
  }
  return out;
}

}  // namespace softscope::test
