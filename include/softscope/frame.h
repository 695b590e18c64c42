// include/softscope/frame.h: stereo images of one frame.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace softscope::api {

/// 8 bits per channel; `channels` 3 (red, green, blue) or
/// 1; height x width x channels, contiguous. Non-owning.
struct ImageView {
  const std::uint8_t* values = nullptr;
  int width_px = 0, height_px = 0, channels = 3;
};

/// Images of one frame. Views must stay valid until the call returns.
struct FrameView {
  ImageView left, right;
  ImageView mask;  // one channel, for the left image; non-zero: ignore. Empty: none
  double time_s = std::numeric_limits<double>::quiet_NaN();
};

/// Red, green, blue; or one channel.
struct Image {
  int width_px = 0, height_px = 0, channels = 3;
  std::vector<std::uint8_t> values;

  ImageView view() const { return {values.data(), width_px, height_px, channels}; }
};

/// Frame of a sequence, or the reason for a failure.
struct Frame {
  int index = 0;
  double time_s = std::numeric_limits<double>::quiet_NaN();  // NaN without timestamps
  Image left, right, mask;                                   // empty mask: none
  std::string error;                                         // empty without an error

  FrameView view() const { return {left.view(), right.view(), mask.view(), time_s}; }
};

}  // namespace softscope::api
