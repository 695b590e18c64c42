// src/core/triangle_mesh.h: surface of vertices and triangles.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/image.h"

namespace softscope {

/// Three indices into TriangleMesh::vertices_mm, counter-clockwise seen from outside.
using Triangle = std::array<std::int32_t, 3>;

/// N vertices, M triangles, mm.
struct TriangleMesh {
  std::vector<Eigen::Vector3f> vertices_mm;
  std::vector<Triangle> triangles;
  std::vector<Rgb8> colours;  // empty, or one per vertex
  std::string space;          // "LPS", "RAS", or empty if unknown
  double unit_mm = 1;         // length of one unit of the file that it was read from

  bool empty() const { return triangles.empty(); }
};

}  // namespace softscope
