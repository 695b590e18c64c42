// eval/simulation/surface/ray_tree.h: ray casting against a triangle mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Where a ray meets a triangle (a, b, c): a + u (b - a) + v (c - a) = origin + distance *
/// direction.
struct RayHit {
  std::int32_t triangle = -1;  // -1: nothing was met
  float u = 0, v = 0;
  float distance = 0;  // in lengths of the direction; with direction z = 1 it is the depth

  bool met() const { return triangle >= 0; }
};

/// Four rays from one origin, traced together.
using RayPacket = std::array<Eigen::Vector3f, 4>;
using PacketHits = std::array<RayHit, 4>;

struct RayTreeNode {
  Eigen::Array3f low_mm, high_mm;
  std::int32_t begin = 0;  // a leaf: its first triangle, in the tree's order; else its second child
  std::int16_t count = 0;  // of a leaf's triangles; 0: an inner node, whose first child comes next
  std::int16_t axis = 0;   // along which an inner node was split
};

struct RayTriangle {
  Eigen::Vector3f a_mm, ab_mm, ac_mm;
  std::int32_t index = 0;  // into the mesh
};

/// A bounding volume hierarchy, rebuilt for every shape of the surface.
class RayTree {
 public:
  /// Copies what it needs. Throws InputError where there is no triangle, an index that no vertex
  /// has, or a vertex that isn't finite.
  RayTree(const std::vector<Eigen::Vector3f>& vertices_mm, const std::vector<Triangle>& triangles);

  /// The closest hits at distance > 0, from both sides of a triangle.
  PacketHits cast(const Eigen::Vector3f& origin_mm, const RayPacket& directions) const;
  RayHit cast(const Eigen::Vector3f& origin_mm, const Eigen::Vector3f& direction) const;

 private:
  std::vector<RayTreeNode> nodes_;
  std::vector<RayTriangle> triangles_;
};

/// Nodes in the order of a depth-first walk; puts `triangles` into the tree's order.
std::vector<RayTreeNode> buildRayTree(std::vector<RayTriangle>& triangles);

}  // namespace softscope
