// src/io/images/picture_limits.h: limits of the image size.
#pragma once

#include <string>

namespace softscope {

inline constexpr int kMostSidePx = 16384;
inline constexpr long kMostPixels = 64L << 20;  // 8192 x 8192

/// Throws InputError with `what` for an empty or implausibly large image.
void requirePictureSize(long width_px, long height_px, const std::string& what);

}  // namespace softscope
