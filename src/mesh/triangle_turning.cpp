// src/mesh/triangle_turning.cpp: propagation over neighbours.
#include "mesh/triangle_turning.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>
#include <vector>

#include "mesh/mesh_sides.h"

namespace softscope {
namespace {

struct Neighbour {
  std::int32_t triangle;
  bool faces_against;
};

std::vector<std::vector<Neighbour>> neighboursOf(const TriangleMesh& mesh) {
  std::vector<std::vector<Neighbour>> neighbours(mesh.triangles.size());
  forEachEdge(sortedSides(mesh), [&](auto first, auto last) {
    if (last - first != 2) return;
    const auto second = first + 1;
    const bool against = first->ascending == second->ascending;
    neighbours[first->triangle].push_back({second->triangle, against});
    neighbours[second->triangle].push_back({first->triangle, against});
  });
  return neighbours;
}

/// Six times the signed volume of a component, relative
/// to one of its vertices, with its new orientation.
double volumeOf(const TriangleMesh& mesh, const std::vector<std::int32_t>& piece,
                const std::vector<signed char>& turned) {
  const Eigen::Vector3d origin = mesh.vertices_mm[mesh.triangles[piece[0]][0]].cast<double>();
  double sum = 0;
  for (const std::int32_t triangle : piece) {
    const Triangle& t = mesh.triangles[triangle];
    const Eigen::Vector3d a = mesh.vertices_mm[t[0]].cast<double>() - origin,
                          b = mesh.vertices_mm[t[1]].cast<double>() - origin,
                          c = mesh.vertices_mm[t[2]].cast<double>() - origin;
    sum += (turned[triangle] == 1 ? -1 : 1) * a.dot(b.cross(c));
  }
  return sum;
}

/// Orients the component of `start`; -1 in `turned`
/// means undecided. Returns false for a contradiction.
bool decidePiece(std::int32_t start, const std::vector<std::vector<Neighbour>>& neighbours,
                 std::vector<signed char>& turned, std::vector<std::int32_t>& piece) {
  piece.assign(1, start);
  turned[start] = 0;
  for (std::size_t i = 0; i < piece.size(); ++i)
    for (const Neighbour& next : neighbours[piece[i]]) {
      const auto wanted = static_cast<signed char>(turned[piece[i]] != int(next.faces_against));
      if (turned[next.triangle] < 0) {
        turned[next.triangle] = wanted;
        piece.push_back(next.triangle);
      }
      if (turned[next.triangle] != wanted) return false;
    }
  return true;
}

}  // namespace

TurnedTriangles orientConsistently(TriangleMesh& mesh) {
  const std::vector<std::vector<Neighbour>> neighbours = neighboursOf(mesh);
  std::vector<signed char> turned(mesh.triangles.size(), -1);
  std::vector<std::int32_t> piece;
  for (std::size_t i = 0; i < turned.size(); ++i) {
    if (turned[i] >= 0) continue;
    if (!decidePiece(static_cast<std::int32_t>(i), neighbours, turned, piece)) return {0, true};
    const bool mixed = std::any_of(piece.begin(), piece.end(),
                                   [&](std::int32_t triangle) { return turned[triangle] == 1; });
    if (mixed && volumeOf(mesh, piece, turned) < 0)
      for (const std::int32_t triangle : piece) turned[triangle] = 1 - turned[triangle];
  }
  TurnedTriangles result;
  for (std::size_t i = 0; i < turned.size(); ++i)
    if (turned[i] == 1) {
      std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
      ++result.count;
    }
  return result;
}

}  // namespace softscope
