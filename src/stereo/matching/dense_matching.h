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

/// The image that gets a disparity.
enum class Reference { kLeft, kRight };

/// Whole disparities of the reference image, -1 for none. `points` in pixels of the
/// reference image. Minimises, per pixel, mean gradient difference + plane prior
/// over the disparities near its plane and those of the surrounding support points.
Raster<std::int16_t> matchDense(const GradientImage& left, const GradientImage& right,
                                Reference reference, const std::vector<SupportPoint>& points,
                                const StereoOptions& options);

}  // namespace softscope
