// src/stereo/refinement/fringes.h: pixels at the end of a measured area that look like what is
// beside it.
#pragma once

#include "core/depth_map.h"
#include "core/image.h"

namespace softscope {

/// Raises the error of measured pixels that look like the unmeasured ones beside them (isFringe())
/// to a step: what is unmeasured there, dark or without texture, may be another surface, and
/// windows at its rim have the disparity of the measured one. Unmeasured pixels are NaN.
void doubtFringes(const GrayImage& left, DisparityMap* map);

}  // namespace softscope
