// tests/simulation/simple_shapes.h: surfaces whose every distance is a formula.
#pragma once

#include "core/triangle_mesh.h"
#include "eval/simulation/tissue/organ_mesh.h"

namespace softscope::test {

/// Vertices on the sphere itself, around the origin, as far apart as a quarter of its girth by
/// `cells_per_side`: the built-in organ without relief, its axes made equal.
inline TriangleMesh makeSphere(float radius_mm, int cells_per_side) {
  OrganOptions options;
  options.cells_per_side = cells_per_side;
  options.lobe_mm = options.fold_mm = 0;
  TriangleMesh mesh = makeOrganMesh(options, 1);
  for (Eigen::Vector3f& vertex : mesh.vertices_mm)
    vertex = radius_mm * (vertex.array() / Eigen::Array3f(1, 0.88F, 0.6F)).matrix().normalized();
  return mesh;
}

/// A flat square, two triangles, z = 0, facing +z.
inline TriangleMesh makeSquare(float side_mm) {
  const float h = 0.5F * side_mm;
  TriangleMesh mesh;
  mesh.vertices_mm = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace softscope::test
