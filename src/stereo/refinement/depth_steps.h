// src/stereo/refinement/depth_steps.h: depth discontinuity mask.
#pragma once

#include <cstdint>

#include "core/raster.h"

namespace softscope {

/// Non-zero where a window of `radius_px` around the pixel reaches across a step: two
/// measured pixels of one row or column, adjacent or with a gap between them no wider than
/// the window, whose disparities differ by more than `step_px` + `slope` * their distance.
Raster<std::uint8_t> nearDepthSteps(const Raster<float>& disparity_px, int radius_px, float step_px,
                                    float slope);

}  // namespace softscope
