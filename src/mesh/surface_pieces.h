// src/mesh/surface_pieces.h: from triangles between points to vertices of their own.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Triangles whose corners are vertices, each of which stands for a point.
struct SurfacePieces {
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> points;  // of each vertex, rising
  std::size_t dropped_pieces = 0;
};

/// Drops pieces with less area than `least_mm2`. A point where sheets touch that share no side
/// there becomes a vertex of each sheet, so that every vertex lies on one. No side may be in more
/// than two triangles.
SurfacePieces assemblePieces(const std::vector<Eigen::Vector3f>& positions_mm,
                             const std::vector<Triangle>& triangles, double least_mm2);

}  // namespace softscope
