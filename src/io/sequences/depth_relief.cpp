// src/io/sequences/depth_relief.cpp: depth minus its low-pass part, scaled to grey levels.
#include "io/sequences/depth_relief.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/geometry/depth_files.h"
#include "io/sequences/frame_pairing.h"
#include "io/text/message.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

constexpr double kSmoothPart = 0.025;    // sigma of the low-pass part / width
constexpr double kLeastReliefMm = 0.02;  // smaller relief is noise and rounding of depth files
constexpr double kGreyPerRelief = 45;

/// Gaussian-weighted mean of the known values.
cv::Mat smoothPart(const cv::Mat& values, const cv::Mat& known, double sigma_px) {
  cv::Mat sum, weight;
  cv::GaussianBlur(values.mul(known), sum, {}, sigma_px);
  cv::GaussianBlur(known, weight, {}, sigma_px);
  return sum / cv::max(weight, 1e-6);
}

class DepthRelief : public PictureSource {
 public:
  DepthRelief(std::vector<fs::path> files, double unit_mm)
      : files_(std::move(files)), unit_mm_(unit_mm) {}

  int count() const override { return static_cast<int>(files_.size()); }
  ColourImage read(int index) override {
    return reliefOf(readDepth(files_[static_cast<std::size_t>(index)], unit_mm_));
  }
  std::string nameOf(int index) const override {
    return shown(files_[static_cast<std::size_t>(index)]);
  }
  bool survivesErrors() const override { return true; }
  std::vector<fs::path> files() const override { return files_; }

 private:
  std::vector<fs::path> files_;
  double unit_mm_;
};

}  // namespace

ColourImage reliefOf(const Raster<float>& depth_mm) {
  const int width_px = depth_mm.width_px, height_px = depth_mm.height_px;
  cv::Mat depth(height_px, width_px, CV_32F), known(height_px, width_px, CV_32F);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      const float z = depth_mm.at(u, v);
      known.at<float>(v, u) = std::isfinite(z) ? 1.0F : 0.0F;
      depth.at<float>(v, u) = std::isfinite(z) ? z : 0.0F;
    }
  const double sigma_px = std::max(2.0, kSmoothPart * width_px);
  const cv::Mat relief = (smoothPart(depth, known, sigma_px) - depth).mul(known);
  const double pixels = std::max(1.0, cv::sum(known)[0]);
  const double usual_mm = std::sqrt(cv::sum(relief.mul(relief))[0] / pixels);
  const double scale = kGreyPerRelief / std::max(usual_mm, kLeastReliefMm);
  ColourImage image(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u) {
      if (known.at<float>(v, u) == 0) continue;
      const double grey = std::clamp(128 + scale * relief.at<float>(v, u), 1.0, 255.0);
      const auto level = static_cast<std::uint8_t>(std::lround(grey));
      image.at(u, v) = {level, level, level};
    }
  return image;
}

std::unique_ptr<PictureSource> openDepthRelief(const fs::path& path, double unit_mm) {
  std::error_code code;
  std::vector<fs::path> files{path};
  if (fs::is_directory(path, code))
    files = filesIn(path, kDepthKinds);
  else
    requireFile(path);
  if (files.empty())
    throw InputError(shown(path) + ": holds no depth files, but png, pfm or tif are expected.");
  return std::make_unique<DepthRelief>(std::move(files), unit_mm);
}

}  // namespace softscope
