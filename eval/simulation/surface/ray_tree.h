// eval/simulation/surface/ray_tree.h: ray casting against a triangle mesh.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Intersection of a ray with triangle (a, b, c): a + u
/// (b - a) + v (c - a) = origin + distance * direction.
struct RayHit {
  std::int32_t triangle = -1;  // -1: no intersection
  float u = 0, v = 0;
  float distance = 0;  // in units of the direction length; for direction z = 1 it is the depth

  bool met() const { return triangle >= 0; }
};

/// Four rays with a common origin, traced together.
using RayPacket = std::array<Eigen::Vector3f, 4>;
using PacketHits = std::array<RayHit, 4>;

struct RayTreeNode {
  Eigen::Array3f low_mm, high_mm;
  std::int32_t begin = 0;  // leaf: first triangle, in the order of the tree; else: second child
  std::int16_t count = 0;  // triangles of a leaf; 0: inner node, whose first child is next
  std::int16_t axis = 0;   // split axis of an inner node
};

struct RayTriangle {
  Eigen::Vector3f a_mm, ab_mm, ac_mm;
  std::int32_t index = 0;  // into the mesh
};

/// Bounding volume hierarchy, rebuilt for every shape of the surface.
class RayTree {
 public:
  /// Copies the required data. Throws InputError without triangles,
  /// for an invalid index, or for a vertex that is not finite.
  RayTree(const std::vector<Eigen::Vector3f>& vertices_mm, const std::vector<Triangle>& triangles);

  /// Closest intersections at distance > 0, on both sides of triangles.
  PacketHits cast(const Eigen::Vector3f& origin_mm, const RayPacket& directions) const;
  RayHit cast(const Eigen::Vector3f& origin_mm, const Eigen::Vector3f& direction) const;

 private:
  std::vector<RayTreeNode> nodes_;
  std::vector<RayTriangle> triangles_;
};

/// Nodes in depth-first order; sorts `triangles` into the order of the tree.
std::vector<RayTreeNode> buildRayTree(std::vector<RayTriangle>& triangles);

}  // namespace softscope
