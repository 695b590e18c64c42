// src/stereo/pyramid.h: disparities of the half size, in the pixels of the full size.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Where `fine` is unmeasured, takes the disparity of the half-size map, in the fine picture's
/// pixels, interpolated between four measured pixels of one surface; its standard error doubles.
void fillFromHalf(const DisparityMap& half, DisparityMap& fine);

}  // namespace softscope
