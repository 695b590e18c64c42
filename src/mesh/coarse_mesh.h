// src/mesh/coarse_mesh.h: mesh simplification that keeps original vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Subset of the vertices of a fine mesh, with triangles. Values
/// and positions of the fine vertices apply without averaging.
struct CoarseMesh {
  std::vector<std::int32_t> vertices;  // indices into the fine mesh, ascending
  std::vector<Triangle> triangles;     // indices into `vertices`

  /// The surface for other positions of the fine vertices, mm.
  TriangleMesh at(const std::vector<Eigen::Vector3f>& fine_vertices_mm) const;
};

/// Groups vertices by grid cells, keeps the vertex nearest
/// to the mean of each group, and the triangles with corners
/// in three groups, except flipped ones. The cell size gives
/// at most `most_vertices` (> 0); a small mesh is unchanged.
CoarseMesh coarsen(const TriangleMesh& fine, std::size_t most_vertices);

}  // namespace softscope
