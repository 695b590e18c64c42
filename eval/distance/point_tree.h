// eval/distance/point_tree.h: distance to the nearest of many points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "eval/distance/triangle_tree.h"

namespace softscope {

/// Exact search of the triangle tree, with points instead of triangles.
class PointTree {
 public:
  /// Copies the points, mm. Throws InputError without points,
  /// or for a point that is not finite or beyond 1 km.
  explicit PointTree(const std::vector<Eigen::Vector3f>& points_mm);

  /// Distance of each query to its nearest point, mm; NaN for a query that is not finite.
  std::vector<double> distances_mm(const std::vector<Eigen::Vector3f>& queries_mm) const;

 private:
  TriangleTree tree_;
};

}  // namespace softscope
