// include/softscope/frame.h: the two images of one moment.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace softscope::api {

/// 8 bits a channel; `channels` 3 (red, green, blue) or 1; height x width x channels without gaps.
/// Owns nothing.
struct ImageView {
  const std::uint8_t* values = nullptr;
  int width_px = 0, height_px = 0, channels = 3;
};

/// What one moment shows. Views must live until the call that takes them returns.
struct FrameView {
  ImageView left, right;
  ImageView mask;  // one channel, of the left image; not 0: ignore the pixel. Empty: none
  double time_s = std::numeric_limits<double>::quiet_NaN();
};

/// Red, green, blue; or one channel.
struct Image {
  int width_px = 0, height_px = 0, channels = 3;
  std::vector<std::uint8_t> values;

  ImageView view() const { return {values.data(), width_px, height_px, channels}; }
};

/// One frame of a sequence, or why it could not be read.
struct Frame {
  int index = 0;
  double time_s = std::numeric_limits<double>::quiet_NaN();  // NaN where the sequence has no clock
  Image left, right, mask;                                   // mask empty: none
  std::string error;                                         // empty where all is well

  FrameView view() const { return {left.view(), right.view(), mask.view(), time_s}; }
};

}  // namespace softscope::api
