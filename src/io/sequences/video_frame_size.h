// src/io/sequences/video_frame_size.h: the size that a packet of a video states.
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

/// Of a JPEG image, or of the sequence parameter set in a packet of H.264 or HEVC (start codes of
/// annex B), as it is shown: coded rows and columns that the set crops are left out (1080 rows are
/// coded as 1088). `codec` is the four-character code. Nothing where the packet states
/// no size, or the codec is another.
std::optional<VideoFrameSize> statedFrameSize(std::string_view packet, const std::string& codec);

}  // namespace softscope
