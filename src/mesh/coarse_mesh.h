// src/mesh/coarse_mesh.h: mesh simplification that keeps original vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Some vertices of a fine mesh and triangles between them. Values of the fine mesh's vertices, and
/// their places at other moments, hold here without averaging.
struct CoarseMesh {
  std::vector<std::int32_t> vertices;  // indices into the fine mesh, rising
  std::vector<Triangle> triangles;     // indices into `vertices`

  /// The surface where the fine mesh's vertices are these, as many as it had. mm.
  TriangleMesh at(const std::vector<Eigen::Vector3f>& fine_vertices_mm) const;
};

/// Groups vertices by the cells of a grid, keeps of each group the one nearest to its mean, and the
/// triangles whose corners are in three groups, but for those that would be folded over. The grid
/// is about as fine as leaves at most `most_vertices` (> 0); a mesh that is small enough stays as
/// it is.
CoarseMesh coarsen(const TriangleMesh& fine, std::size_t most_vertices);

}  // namespace softscope
