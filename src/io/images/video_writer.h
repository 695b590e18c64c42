// src/io/images/video_writer.h: images to a video, written atomically.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.h"

namespace softscope {

/// H.264 where the codec library can write it, else MPEG-4; the file's kind decides the container.
class VideoWriter {
 public:
  /// Throws OptionError where the file exists and `overwrite` is false, Error where no video of
  /// this kind or size can be written here.
  VideoWriter(std::filesystem::path target, int width_px, int height_px, double frames_per_second,
              bool overwrite);
  ~VideoWriter();  // without finish() nothing stays
  VideoWriter(VideoWriter&&) noexcept;

  /// Throws Error where its size is another.
  void add(const ColourImage& picture);
  /// Reads the video back and gives the file its name. Throws Error where a frame is missing: the
  /// encoder does not report that the disk is full.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softscope
