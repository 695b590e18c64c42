// src/stereo/matching/delaunay.h: Delaunay triangulation of points at whole pixels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace softscope {

/// Delaunay triangles as indices into `points`, counter-clockwise in the image (x right, y
/// down). Computed in integers, so exact. Of several points on one circle without a point
/// inside, the first in raster order (smallest y, then x) is joined to all others, so the
/// triangles depend on the positions only; they are in raster order of their first corner. Of
/// equal points the first is used. Throws Error if two coordinates differ by 2^30 or more.
std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2i>& points);

}  // namespace softscope
