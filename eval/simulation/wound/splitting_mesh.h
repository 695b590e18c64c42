// eval/simulation/wound/splitting_mesh.h: mesh
// with edge splits that preserve its shape.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// Vertices and triangles are only added; existing ones keep their numbers.
class SplittingMesh {
 public:
  /// Throws InputError for an invalid vertex index.
  explicit SplittingMesh(const TriangleMesh& organ);

  /// Inserts a vertex at a + share (b - a); both adjacent triangles are split. Returns its
  /// number. Throws InputError unless the edge has two consistently oriented triangles.
  std::int32_t split(std::int32_t a, std::int32_t b, double share);

  /// Triangle with the directed edge a to b. Throws InputError unless there is exactly one.
  std::int32_t triangleAt(std::int32_t a, std::int32_t b) const;
  /// Third corner of triangleAt(a, b).
  std::int32_t cornerOpposite(std::int32_t a, std::int32_t b) const;

  const std::vector<Eigen::Vector3f>& vertices() const { return vertices_mm_; }
  const std::vector<Triangle>& triangles() const { return triangles_; }
  const std::vector<OrganPlace>& places() const { return places_; }

 private:
  static std::uint64_t keyOf(std::int32_t a, std::int32_t b) {
    return std::uint64_t(std::uint32_t(a)) << 32 | std::uint32_t(b);
  }
  void halve(std::int32_t a, std::int32_t b, std::int32_t middle);

  std::vector<Eigen::Vector3f> vertices_mm_;
  std::vector<Triangle> triangles_;
  std::vector<OrganPlace> places_;
  std::unordered_map<std::uint64_t, std::int32_t> triangle_at_;  // by directed edge; -1: several
};

}  // namespace softscope
