// src/stereo/matching/delaunay.h: the triangulation of points at whole pixels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace softscope {

/// Delaunay triangles as indices into `points`; exact on integers, so points on a grid (many on one
/// circle) or on one line are no special case. Points must be distinct.
std::vector<std::array<int, 3>> delaunay(const std::vector<Eigen::Vector2i>& points);

}  // namespace softscope
