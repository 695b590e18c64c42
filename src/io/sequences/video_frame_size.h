// src/io/sequences/video_frame_size.h: frame size in a video packet.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace softscope {

struct VideoFrameSize {
  int width_px = 0;
  int height_px = 0;

  bool operator==(const VideoFrameSize& other) const {
    return width_px == other.width_px && height_px == other.height_px;
  }
};

/// From a JPEG image, or the sequence parameter set in a packet of
/// H.264 or HEVC (start codes of annex B), as displayed: after cropping
/// (1080 rows are coded as 1088). `codec` is the four-character code.
/// None for a packet without a size, or another codec.
std::optional<VideoFrameSize> statedFrameSize(std::string_view packet, const std::string& codec);

}  // namespace softscope
