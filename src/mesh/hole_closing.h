// src/mesh/hole_closing.h: closing of holes.
#pragma once

#include "core/triangle_mesh.h"

namespace softscope {

struct ClosedHoles {
  int closed = 0, left_open = 0;
  int edges = 0;         // of those that were closed
  double widest_mm = 0;  // of those, the diagonal of its box
};

/// Puts a fan around the middle of each hole no wider than `widest_mm`; vertices and triangles are
/// added, none changed. Takes an oriented manifold; throws Error where it isn't one.
ClosedHoles closeHoles(TriangleMesh& mesh, double widest_mm);

}  // namespace softscope
