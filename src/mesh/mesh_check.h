// src/mesh/mesh_check.h: checks of a mesh: closed, oriented, manifold, plausible size.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Neighbours are triangles with two common vertices. Triangles
/// with a repeated vertex count as degenerate and have no edges.
struct MeshCheck {
  std::size_t vertex_count = 0;
  std::size_t triangle_count = 0;
  std::size_t unused_vertices = 0;                   // without a triangle
  std::size_t degenerate_triangles = 0;              // below a millionth of their longest side
  std::size_t border_edges = 0;                      // with one triangle
  std::size_t crowded_edges = 0;                     // with more than two triangles
  std::size_t flipped_edges = 0;                     // with two triangles of opposite orientation
  std::size_t split_vertices = 0;                    // sheets touch in this point only
  std::size_t components = 0;                        // connected components
  Eigen::Vector3f low_mm = Eigen::Vector3f::Zero();  // box of the used vertices
  Eigen::Vector3f high_mm = Eigen::Vector3f::Zero();
  double area_mm2 = 0;
  double volume_mm3 = 0;      // NaN unless closed and oriented; negative if inside out
  double likely_unit_mm = 1;  // 1000 for a box in metres, 0.001 for micrometres, else 1

  bool closed() const { return border_edges == 0 && triangle_count > 0; }
  bool manifold() const { return crowded_edges == 0 && split_vertices == 0; }
  bool oriented() const { return flipped_edges == 0; }
  Eigen::Vector3f size_mm() const { return high_mm - low_mm; }
};

/// Requires valid indices and finite vertices, as ensured by readMesh.
MeshCheck checkMesh(const TriangleMesh& mesh);

/// Warnings, one line each; empty for a closed, oriented, manifold surface in mm.
/// `unit_option`: the options that state the unit of the file.
std::vector<std::string> meshWarnings(const MeshCheck& check,
                                      const std::string& unit_option = "unit in mm");

}  // namespace softscope
