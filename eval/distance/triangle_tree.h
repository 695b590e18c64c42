// eval/distance/triangle_tree.h: signed distance of points from a triangle mesh.
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

/// Beside a border by more than this there is no surface; less is rounding of floats near 300 mm.
inline constexpr double kBeyondBorder_mm = 1e-3;

/// The point of a surface that lies closest to a query point.
struct ClosestPoint {
  Eigen::Vector3d point_mm;   // on the surface
  double distance_mm;         // >= 0
  double signed_distance_mm;  // > 0 outside; NaN on a border, where no side is outside
  std::int32_t triangle;      // index into the mesh; of equally close ones the lowest; -1 = none
  SurfaceFeature feature;     // what of the triangle the point lies on
  bool on_border;             // the feature belongs to an edge that is not closed
  double aside_mm;            // on a border: how far beside the surface the point lies, else 0
};

/// Whether the point lies beyond the rim of an open surface, which says nothing of that place: a
/// distance from the rim is no error.
inline bool isBeyondBorder(const ClosestPoint& closest) {
  return closest.aside_mm > kBeyondBorder_mm;
}

/// Finds closest points on the triangles of a mesh (not on its vertices alone). Exact: the search
/// in float only proposes candidates, double decides. The answers depend neither on the number of
/// threads nor on the instruction set.
class TriangleTree {
 public:
  /// Copies what it needs of the mesh. Throws InputError if the mesh has no triangles, an index
  /// that no vertex has, or a vertex that is not finite or beyond 1 km.
  explicit TriangleTree(const TriangleMesh& mesh);

  /// N points, mm, in the mesh's frame; the answers are in the points' order. A point that is not
  /// finite, or beyond kFarthestPoint_mm, gets NaN, triangle -1 and SurfaceFeature::kNone.
  std::vector<ClosestPoint> closestPoints(const std::vector<Eigen::Vector3f>& points_mm) const;

  /// The same with a chosen instruction set.
  std::vector<ClosestPoint> closestPoints(const std::vector<Eigen::Vector3f>& points_mm,
                                          const TreeKernels& kernels) const;

  /// Unit normal of a triangle, zero if it has no area.
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
