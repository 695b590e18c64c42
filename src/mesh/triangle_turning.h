// src/mesh/triangle_turning.h: consistent orientation of neighbouring triangles.
#pragma once

#include <cstddef>

#include "core/triangle_mesh.h"

namespace softscope {

struct TurnedTriangles {
  std::size_t count = 0;
  bool one_sided = false;  // not orientable: nothing was changed
};

/// Orients neighbouring triangles consistently, and a changed component
/// outward. Components that are already consistent are unchanged: an inner
/// one may be a cavity. No edge may belong to more than two triangles.
TurnedTriangles orientConsistently(TriangleMesh& mesh);

}  // namespace softscope
