// src/mesh/hole_closing.h: closing of holes.
#pragma once

#include "core/triangle_mesh.h"

namespace softscope {

struct ClosedHoles {
  int closed = 0, left_open = 0;
  int edges = 0;         // of the closed holes
  double widest_mm = 0;  // largest diagonal of the box of a closed hole
};

/// Fills holes no wider than `widest_mm` with a fan around their centre; only adds
/// vertices and triangles. Requires an oriented manifold; throws Error otherwise.
ClosedHoles closeHoles(TriangleMesh& mesh, double widest_mm);

}  // namespace softscope
