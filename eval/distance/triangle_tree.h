// eval/distance/triangle_tree.h: signed distance of points to a triangle mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/distance/pseudo_normals.h"
#include "eval/distance/tree_build.h"
#include "eval/distance/tree_kernels.h"

namespace softscope {

enum class SurfaceFeature : std::uint8_t { kFace, kEdge, kVertex, kNone };

/// Points farther outside of a border have no surface; less is float rounding near 300 mm.
inline constexpr double kBeyondBorder_mm = 1e-3;

/// Point of a surface closest to a query point.
struct ClosestPoint {
  Eigen::Vector3d point_mm;   // on the surface
  double distance_mm;         // >= 0
  double signed_distance_mm;  // > 0 outside; NaN on a border, where the sign is undefined
  std::int32_t triangle;      // index into the mesh; the lowest of equally close ones; -1 = none
  SurfaceFeature feature;     // part of the triangle that contains the point
  bool on_border;             // the feature belongs to an open edge
  double aside_mm;            // on a border: lateral distance of the query to the surface, else 0
};

/// True for a point beyond the border of an open surface, where the
/// truth is unknown: the distance to the border is not an error.
inline bool isBeyondBorder(const ClosestPoint& closest) {
  return closest.aside_mm > kBeyondBorder_mm;
}

/// Finds closest points on the triangles of a mesh, not on its vertices only.
/// Exact: the search in float selects candidates, double decides. Results
/// depend neither on the number of threads nor on the instruction set.
class TriangleTree {
 public:
  /// Copies the required parts of the mesh. Throws InputError for a mesh without
  /// triangles, an invalid index, or a vertex that is not finite or beyond 1 km.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// N points, mm, in the frame of the mesh; results in the order of the points. A point that is
  /// not finite, or beyond kFarthestPoint_mm, gets NaN, triangle -1 and SurfaceFeature::kNone.
  std::vector<ClosestPoint> closestPoints(const std::vector<Eigen::Vector3f>& points_mm) const;

  /// With a given instruction set.
  std::vector<ClosestPoint> closestPoints(const std::vector<Eigen::Vector3f>& points_mm,
                                          const TreeKernels& kernels) const;

  /// Unit normal of a triangle, zero for a degenerate triangle.
  const Eigen::Vector3d& faceNormal(std::int32_t triangle) const { return sides_.ofFace(triangle); }

 private:
  TreeView view() const;
  ClosestPoint describe(const TreeHit& hit, const Eigen::Vector3f& point_mm) const;

  std::vector<Eigen::Vector3f> vertices_mm_;
  std::vector<Triangle> triangles_;
  Eigen::Vector3f low_mm_, high_mm_;  // box of the vertices
  PseudoNormals sides_;
  TreeMemory memory_;
};

}  // namespace softscope
