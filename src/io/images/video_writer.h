// src/io/images/video_writer.h: atomic writer of videos.
#pragma once

#include <filesystem>
#include <memory>

#include "core/image.h"

namespace softscope {

/// H.264 if supported by the codec library, else MPEG-4; the file extension selects the container.
class VideoWriter {
 public:
  /// Throws OptionError if the file exists and `overwrite` is false,
  /// Error if a video of this kind or size cannot be written.
  VideoWriter(std::filesystem::path target, int width_px, int height_px, double frames_per_second,
              bool overwrite);
  ~VideoWriter();  // removes the file without finish()
  VideoWriter(VideoWriter&&) noexcept;

  /// Throws Error for another image size.
  void add(const ColourImage& picture);
  /// Reads the video back and renames it. Throws Error for a
  /// missing frame: the encoder does not report a full disk.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace softscope
