// src/stereo/pyramid.h: the same pictures at half their size.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Means of 2 x 2 pixels, rounded; an odd last row or column is left out. Pixel (u, v) of the half
/// lies at (2 u + 0.5, 2 v + 0.5) of the whole.
GrayImage halve(const GrayImage& image);

/// Where `fine` is unmeasured, takes the disparity of the half-size map, in the fine picture's
/// pixels, interpolated between four measured pixels of one surface; its standard error doubles.
void fillFromHalf(const DisparityMap& half, DisparityMap& fine);

}  // namespace softscope
