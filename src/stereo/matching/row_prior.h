// src/stereo/matching/row_prior.h: disparity prior per pixel, interpolated from the support points
// (ELAS §3.2, without a triangulation).
#pragma once

#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "stereo/matching/support_points.h"

namespace softscope {

/// Prior of an image without support points.
constexpr std::int16_t kNoPrior = INT16_MIN;

/// Prior disparity per pixel, unit 1/8 px (docs/stereo.md 3.2). Each row with points is
/// interpolated linearly between them and constant beyond them; a pixel is interpolated
/// between the nearest evidence above and below it. `points`: in the frame of the
/// matched image, in any order; of several on one pixel the largest disparity counts;
/// points outside of the image are ignored. All kNoPrior without a point.
Raster<std::int16_t> interpolateRows(const std::vector<SupportPoint>& points, int width_px,
                                     int height_px);

}  // namespace softscope
