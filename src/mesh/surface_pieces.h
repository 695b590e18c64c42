// src/mesh/surface_pieces.h: vertices of triangles between points, separated by sheet.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Triangles with vertices that refer to points.
struct SurfacePieces {
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> points;  // of each vertex, ascending
  std::size_t dropped_pieces = 0;
};

/// Drops components with an area below `least_mm2`. A point
/// where sheets touch without a common side becomes one vertex
/// per sheet. No side may belong to more than two triangles.
SurfacePieces assemblePieces(const std::vector<Eigen::Vector3f>& positions_mm,
                             const std::vector<Triangle>& triangles, double least_mm2);

}  // namespace softscope
