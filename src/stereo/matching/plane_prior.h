// src/stereo/matching/plane_prior.h: disparity prior by planes through triangles of support points
// (ELAS §3.2).
#pragma once

#include <cstdint>
#include <vector>

#include "core/raster.h"
#include "stereo/matching/support_points.h"

namespace softscope {

/// Per pixel the disparity of the plane of its triangle, in 1/8 px; kNoPrior outside.
constexpr std::int16_t kNoPrior = INT16_MIN;

/// Points in the frame of the matched image; the corners of the image
/// are added with the disparity of their nearest support point.
Raster<std::int16_t> interpolatePlanes(std::vector<SupportPoint> points, int width_px,
                                       int height_px);

}  // namespace softscope
