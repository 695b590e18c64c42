// src/stereo/matching/support_points.h: pixels that can be matched without help (ELAS §3.1).
#pragma once

#include <vector>

#include "core/raster.h"
#include "stereo/images/gradient_image.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// A pixel of the left picture and its disparity, refined by a parabola through three costs.
struct SupportPoint {
  int u_px, v_px;
  float disparity_px;
};

/// Matches a grid of pixels over the whole range of disparities (every fourth row; the others over
/// the range found there), keeps what is unique, textured,
/// confirmed from right to left and by its neighbours, and drops what its neighbours say already.
/// In raster order. Rows of the right picture are sought `row_offset_px` below those of the left.
std::vector<SupportPoint> findSupportPoints(const GradientImage& left, const GradientImage& right,
                                            const StereoOptions& options, int row_offset_px = 0);

/// The points of a grid of disparities, kNoSupport where there is none; for the prior by planes
/// without those that their neighbours say already. In raster order.
std::vector<SupportPoint> pointsOf(Raster<float> grid, const ElasOptions& options);

/// The same points as the right image sees them.
std::vector<SupportPoint> seenFromRight(std::vector<SupportPoint> points);

/// The same options with the range of disparities in which these lie, and some more on either side;
/// strays don't count. As given where there are few.
StereoOptions narrowedTo(const std::vector<float>& disparities_px, StereoOptions options);

}  // namespace softscope
