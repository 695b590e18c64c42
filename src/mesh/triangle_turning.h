// src/mesh/triangle_turning.h: consistent orientation of neighbouring triangles.
#pragma once

#include <cstddef>

#include "core/triangle_mesh.h"

namespace softscope {

struct TurnedTriangles {
  std::size_t count = 0;
  bool one_sided = false;  // nothing was turned then
};

/// Turns triangles so that neighbours over an edge face alike, and a piece in which some had to be
/// turned faces outward. Pieces that were of one mind stay as they are: one inside another may be a
/// cavity. No edge may belong to more than two triangles.
TurnedTriangles turnAlike(TriangleMesh& mesh);

}  // namespace softscope
