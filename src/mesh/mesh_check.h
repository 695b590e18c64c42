// src/mesh/mesh_check.h: checks of a mesh: closed, oriented, manifold, plausible size.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Neighbours are triangles that name the same two vertices. Triangles that name a vertex twice
/// count as degenerate and take no part in edges.
struct MeshCheck {
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
  std::size_t unused_vertices = 0;                   // named by no triangle
  std::size_t degenerate_triangles = 0;              // lower than a millionth of their longest side
  std::size_t border_edges = 0;                      // of one triangle
  std::size_t crowded_edges = 0;                     // of more than two
  std::size_t flipped_edges = 0;                     // of two triangles that face opposite ways
  std::size_t split_vertices = 0;                    // where sheets touch in this point alone
  std::size_t components = 0;                        // pieces that share no vertex
  Eigen::Vector3f low_mm = Eigen::Vector3f::Zero();  // box of the vertices that triangles name
  Eigen::Vector3f high_mm = Eigen::Vector3f::Zero();
  double area_mm2 = 0;
  double volume_mm3 = 0;      // NaN unless closed and oriented; negative where inside out
  double likely_unit_mm = 1;  // 1000 for a box of metres, 0.001 of micrometres, else 1: no doubt

  bool closed() const { return border_edges == 0 && triangle_count > 0; }
  bool manifold() const { return crowded_edges == 0 && split_vertices == 0; }
  bool oriented() const { return flipped_edges == 0; }
  Eigen::Vector3f size_mm() const { return high_mm - low_mm; }
};

/// The mesh must have valid indices and finite vertices, as readMesh ensures.
MeshCheck checkMesh(const TriangleMesh& mesh);

/// What a user should know, a line each; empty for a closed, oriented, manifold surface in mm.
std::vector<std::string> meshWarnings(const MeshCheck& check);

}  // namespace softscope
