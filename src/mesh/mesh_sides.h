// src/mesh/mesh_sides.h: sides of triangles grouped by edge.
#pragma once

#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Side k of a triangle: from corner k to the next.
struct MeshSide {
  std::int32_t low, high;  // vertices
  std::int32_t triangle;
  std::int8_t k;
  bool ascending;  // runs from low to high

  bool sameEdge(const MeshSide& other) const { return low == other.low && high == other.high; }
};

/// True for a repeated vertex.
inline bool isFolded(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// Sorted, so that sides of one edge are consecutive; without degenerate triangles.
std::vector<MeshSide> sortedSides(const TriangleMesh& mesh);

/// Calls use(first, last) with iterators over the sides of each edge.
template <class Use>
void forEachEdge(const std::vector<MeshSide>& sides, Use use) {
  for (auto first = sides.begin(); first != sides.end();) {
    auto last = first;
    while (last != sides.end() && last->sameEdge(*first)) ++last;
    use(first, last);
    first = last;
  }
}

}  // namespace softscope
