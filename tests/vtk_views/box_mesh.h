// tests/vtk_views/box_mesh.h: the simplest closed surface.
#pragma once

#include <array>

#include "core/triangle_mesh.h"

namespace softscope {

/// A box from `low` to `high`, its faces outwards.
inline TriangleMesh boxMesh(const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices_mm.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                                  i & 4 ? high.z() : low.z());
  for (const auto& q : {std::array<int, 4>{0, 2, 3, 1},
                        {4, 5, 7, 6},
                        {0, 1, 5, 4},
                        {2, 6, 7, 3},
                        {0, 4, 6, 2},
                        {1, 3, 7, 5}}) {
    mesh.triangles.push_back({q[0], q[1], q[2]});
    mesh.triangles.push_back({q[0], q[2], q[3]});
  }
  return mesh;
}

}  // namespace softscope
