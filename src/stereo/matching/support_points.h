// src/stereo/matching/support_points.h: distinctive, robust matches (ELAS §3.1).
#pragma once

#include <vector>

#include "core/raster.h"
#include "stereo/images/gradient_image.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// A pixel of the left image and its disparity, refined by a parabola through three costs.
struct SupportPoint {
  int u_px, v_px;
  float disparity_px;
};

/// Matches a grid of pixels over the whole range of disparities (every fourth row; the others
/// over the range found there) and keeps those that are unique, textured, cross-checked and
/// confirmed by their neighbours. In raster order. Rows of the right image are searched
/// `row_offset_px` below those of the left.
std::vector<SupportPoint> findSupportPoints(const GradientImage& left, const GradientImage& right,
                                            const StereoOptions& options, int row_offset_px = 0);

/// The same points in the right image.
std::vector<SupportPoint> supportFromRight(std::vector<SupportPoint> points);

/// The same options with the range of these disparities, and a margin on
/// either side; outliers do not count. Unchanged for few disparities.
StereoOptions narrowedTo(const std::vector<float>& disparities_px, StereoOptions options);

}  // namespace softscope
