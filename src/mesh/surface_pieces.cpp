// src/mesh/surface_pieces.cpp: corners with common sides share a vertex.
#include "mesh/surface_pieces.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "mesh/union_find.h"

namespace softscope {
namespace {

/// Side of a triangle; `corner` is at `low`, `next` at `high`.
struct CornerSide {
  std::int32_t low, high;  // points
  std::int32_t corner, next;
};

std::int32_t cornerOf(std::size_t triangle, std::size_t k) {
  return std::int32_t(3 * triangle + k % 3);
}

/// Joins corners of the same point if their triangles share a side.
UnionFind joinedCorners(const std::vector<Triangle>& triangles) {
  std::vector<CornerSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      const std::int32_t at_a = cornerOf(i, k), at_b = cornerOf(i, k + 1);
      sides.push_back(a < b ? CornerSide{a, b, at_a, at_b} : CornerSide{b, a, at_b, at_a});
    }
  std::sort(sides.begin(), sides.end(), [](const CornerSide& a, const CornerSide& b) {
    if (a.low != b.low) return a.low < b.low;
    return a.high != b.high ? a.high < b.high : a.corner < b.corner;
  });
  UnionFind corners(3 * triangles.size());
  for (std::size_t i = 1; i < sides.size(); ++i) {
    const CornerSide &one = sides[i - 1], &other = sides[i];
    if (one.low != other.low || one.high != other.high) continue;
    corners.join(one.corner, other.corner);
    corners.join(one.next, other.next);
  }
  return corners;
}

double areaOf(const std::vector<Eigen::Vector3f>& positions_mm, const Triangle& t) {
  const Eigen::Vector3d a = positions_mm[std::size_t(t[0])].cast<double>();
  const Eigen::Vector3d b = positions_mm[std::size_t(t[1])].cast<double>();
  const Eigen::Vector3d c = positions_mm[std::size_t(t[2])].cast<double>();
  return (b - a).cross(c - a).norm() / 2;
}

/// Per triangle whether its component is large enough; counts the other components.
std::vector<char> largeOnes(const std::vector<Eigen::Vector3f>& positions_mm,
                            const std::vector<Triangle>& triangles, UnionFind& corners,
                            double least_mm2, std::size_t& dropped) {
  UnionFind pieces(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      pieces.join(corners.find(cornerOf(i, k)), corners.find(cornerOf(i, 0)));
  const auto pieceOf = [&](std::size_t i) {
    return std::size_t(pieces.find(corners.find(cornerOf(i, 0))));
  };
  std::vector<double> area_mm2(3 * triangles.size(), 0);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    area_mm2[pieceOf(i)] += areaOf(positions_mm, triangles[i]);
  std::vector<char> large(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) large[i] = area_mm2[pieceOf(i)] >= least_mm2;
  dropped = std::size_t(std::count_if(area_mm2.begin(), area_mm2.end(),
                                      [&](double area) { return area > 0 && area < least_mm2; }));
  return large;
}

}  // namespace

SurfacePieces assemblePieces(const std::vector<Eigen::Vector3f>& positions_mm,
                             const std::vector<Triangle>& triangles, double least_mm2) {
  SurfacePieces made;
  UnionFind corners = joinedCorners(triangles);
  const std::vector<char> large =
      largeOnes(positions_mm, triangles, corners, least_mm2, made.dropped_pieces);
  // One (point, joined corner) per vertex, in the order of the points.
  std::vector<std::pair<std::int32_t, std::int32_t>> vertices;
  const auto vertexAt = [&](std::size_t i, std::size_t k) {
    return std::make_pair(triangles[i][k], corners.find(cornerOf(i, k)));
  };
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; large[i] && k < 3; ++k) vertices.push_back(vertexAt(i, k));
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  for (const auto& vertex : vertices) made.points.push_back(vertex.first);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (!large[i]) continue;
    Triangle t{};
    for (std::size_t k = 0; k < 3; ++k)
      t[k] = std::int32_t(std::lower_bound(vertices.begin(), vertices.end(), vertexAt(i, k)) -
                          vertices.begin());
    made.triangles.push_back(t);
  }
  return made;
}

}  // namespace softscope
