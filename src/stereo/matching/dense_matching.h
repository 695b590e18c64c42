// src/stereo/matching/dense_matching.h: the best disparity of every pixel under its prior (ELAS
// §3.3).
#pragma once

#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "stereo/images/gradient_image.h"
#include "stereo/matching/support_points.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Which of the two images gets a disparity.
enum class Reference { kLeft, kRight };

/// Whole disparities of the reference image, -1 where there is none. `points` in the reference
/// image's pixels. Minimises, per pixel, mean gradient difference + plane prior over the
/// disparities near its plane and those of the support points around it.
Raster<std::int16_t> matchDense(const GradientImage& left, const GradientImage& right,
                                Reference reference, const std::vector<SupportPoint>& points,
                                const StereoOptions& options);

}  // namespace softscope
