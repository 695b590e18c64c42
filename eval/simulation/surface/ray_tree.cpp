// eval/simulation/surface/ray_tree.cpp: traversal by packets of four rays.
#include "eval/simulation/surface/ray_tree.h"

#include <Eigen/Geometry>
#include <limits>

#include "core/error.h"

namespace softscope {
namespace {

using Four = Eigen::Array4f;

/// Tolerance for rays along the edge of a triangle: triangles overlap slightly.
constexpr float kEdgeOverlap = 1e-5F;
constexpr int kDeepest = 64;  // median splits of 2^31 triangles have less than 32 levels

struct Rays {
  Eigen::Vector3f origin_mm;
  Four dx, dy, dz;  // directions
  Four inverse[3];  // 1 / direction, never infinite
  Four distance;    // of the closest hit so far
  PacketHits hits;
};

Four inverseOf(const Four& d) {
  constexpr float kTiny = 1e-20F;
  Four safe = d;
  for (int i = 0; i < 4; ++i)
    if (std::abs(safe[i]) < kTiny) safe[i] = safe[i] < 0 ? -kTiny : kTiny;
  return safe.inverse();
}

Rays raysOf(const Eigen::Vector3f& origin_mm, const RayPacket& d) {
  Rays rays;
  rays.origin_mm = origin_mm;
  rays.dx = Four(d[0].x(), d[1].x(), d[2].x(), d[3].x());
  rays.dy = Four(d[0].y(), d[1].y(), d[2].y(), d[3].y());
  rays.dz = Four(d[0].z(), d[1].z(), d[2].z(), d[3].z());
  rays.inverse[0] = inverseOf(rays.dx);
  rays.inverse[1] = inverseOf(rays.dy);
  rays.inverse[2] = inverseOf(rays.dz);
  rays.distance = Four::Constant(std::numeric_limits<float>::max());
  return rays;
}

bool anyEnters(const Rays& rays, const RayTreeNode& node) {
  Four enter = Four::Zero(), leave = rays.distance;
  for (int axis = 0; axis < 3; ++axis) {
    const Four t0 = (node.low_mm[axis] - rays.origin_mm[axis]) * rays.inverse[axis];
    const Four t1 = (node.high_mm[axis] - rays.origin_mm[axis]) * rays.inverse[axis];
    enter = enter.max(t0.min(t1));
    leave = leave.min(t0.max(t1));
  }
  return (enter <= leave * (1 + 4e-7F)).any();
}

/// Möller and Trumbore 1997, for four rays.
void meet(Rays& rays, const RayTriangle& t) {
  const Eigen::Vector3f &e1 = t.ab_mm, &e2 = t.ac_mm;
  const Eigen::Vector3f s = rays.origin_mm - t.a_mm;
  const Eigen::Vector3f q = s.cross(e1);
  const Four px = rays.dy * e2.z() - rays.dz * e2.y();
  const Four py = rays.dz * e2.x() - rays.dx * e2.z();
  const Four pz = rays.dx * e2.y() - rays.dy * e2.x();
  const Four determinant = px * e1.x() + py * e1.y() + pz * e1.z();
  const Four scale = determinant.inverse();
  const Four u = (px * s.x() + py * s.y() + pz * s.z()) * scale;
  const Four v = (rays.dx * q.x() + rays.dy * q.y() + rays.dz * q.z()) * scale;
  const Four distance = e2.dot(q) * scale;
  // Ray by ray: under sanitizers clang calls each step of one expression of Eigen over all four.
  for (int i = 0; i < 4; ++i) {
    const float ui = u[i], vi = v[i], distance_i = distance[i];
    const bool inside = ui >= -kEdgeOverlap && vi >= -kEdgeOverlap && ui + vi <= 1 + kEdgeOverlap;
    if (inside && determinant[i] != 0 && distance_i > 0 && distance_i < rays.distance[i]) {
      rays.distance[i] = distance_i;
      rays.hits[i] = {t.index, ui, vi, distance_i};
    }
  }
}

std::vector<RayTriangle> collect(const std::vector<Eigen::Vector3f>& vertices_mm,
                                 const std::vector<Triangle>& triangles) {
  if (triangles.empty()) throw InputError("the surface has no triangle; rays need at least one");
  for (const Eigen::Vector3f& vertex : vertices_mm)
    if (!vertex.allFinite()) throw InputError("the surface has a vertex that is not finite");
  std::vector<RayTriangle> collected;
  collected.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::int32_t vertex : triangles[i])
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices_mm.size())
        throw InputError("triangle " + std::to_string(i) + " of the surface names vertex " +
                         std::to_string(vertex) + ", but there are " +
                         std::to_string(vertices_mm.size()));
    const Eigen::Vector3f& a = vertices_mm[triangles[i][0]];
    collected.push_back({a, vertices_mm[triangles[i][1]] - a, vertices_mm[triangles[i][2]] - a,
                         static_cast<std::int32_t>(i)});
  }
  return collected;
}

}  // namespace

RayTree::RayTree(const std::vector<Eigen::Vector3f>& vertices_mm,
                 const std::vector<Triangle>& triangles)
    : triangles_(collect(vertices_mm, triangles)) {
  nodes_ = buildRayTree(triangles_);
}

PacketHits RayTree::cast(const Eigen::Vector3f& origin_mm, const RayPacket& directions) const {
  Rays rays = raysOf(origin_mm, directions);
  std::int32_t waiting[kDeepest];
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::int32_t index = waiting[--count];
    const RayTreeNode& node = nodes_[index];
    if (!anyEnters(rays, node)) continue;
    if (node.count > 0) {
      for (int i = node.begin; i < node.begin + node.count; ++i) meet(rays, triangles_[i]);
      continue;
    }
    const bool forward = directions[0][node.axis] >= 0;  // the nearer child is visited first
    waiting[count++] = forward ? node.begin : index + 1;
    waiting[count++] = forward ? index + 1 : node.begin;
  }
  return rays.hits;
}

RayHit RayTree::cast(const Eigen::Vector3f& origin_mm, const Eigen::Vector3f& direction) const {
  return cast(origin_mm, RayPacket{direction, direction, direction, direction})[0];
}

}  // namespace softscope
