// src/stereo/refinement/rims.h: pixels beside a step to a farther surface.
#pragma once

#include "core/depth_map.h"

namespace softscope {

/// Raises the error of pixels of a near surface within kRimReachPx of its rims (rimDisparity()) to
/// the step: windows there see both surfaces, and pixels of the farther one may have the disparity
/// of the nearer. Unmeasured pixels are NaN.
void doubtRims(DisparityMap* map);

}  // namespace softscope
