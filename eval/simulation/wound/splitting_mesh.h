// eval/simulation/wound/splitting_mesh.h: a surface whose edges can be split without changing its
// shape.
#pragma once

#include <unordered_map>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/simulation/tissue/tissue_body.h"

namespace softscope {

/// Vertices and triangles only ever are added; those that were there keep their numbers.
class SplittingMesh {
 public:
  /// Throws InputError where a triangle names a vertex that isn't there.
  explicit SplittingMesh(const TriangleMesh& organ);

  /// Puts a vertex at a + share (b - a); both triangles of the edge become two. Returns its
  /// number. Throws InputError where the edge hasn't two triangles that face alike.
  std::int32_t split(std::int32_t a, std::int32_t b, double share);

  /// The triangle that runs from a to b. Throws InputError where there isn't just one.
  std::int32_t triangleAt(std::int32_t a, std::int32_t b) const;
  /// The corner of triangleAt(a, b) that is neither.
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
  std::unordered_map<std::uint64_t, std::int32_t> triangle_at_;  // of directed edges; -1: several
};

}  // namespace softscope
