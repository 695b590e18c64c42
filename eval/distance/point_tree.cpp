// eval/distance/point_tree.cpp: a point is a triangle with three equal corners.
#include "eval/distance/point_tree.h"

#include "core/error.h"

namespace softscope {
namespace {

TriangleMesh meshOfPoints(const std::vector<Eigen::Vector3f>& points_mm) {
  if (points_mm.empty())
    throw InputError("there is no point, so no distance to the nearest exists; give points");
  TriangleMesh mesh;
  mesh.vertices_mm = points_mm;
  mesh.triangles.reserve(points_mm.size());
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(points_mm.size()); ++i)
    mesh.triangles.push_back({i, i, i});
  return mesh;
}

}  // namespace

PointTree::PointTree(const std::vector<Eigen::Vector3f>& points_mm)
    : tree_(meshOfPoints(points_mm)) {}

std::vector<double> PointTree::distances_mm(const std::vector<Eigen::Vector3f>& queries_mm) const {
  std::vector<double> distances_mm;
  distances_mm.reserve(queries_mm.size());
  for (const ClosestPoint& closest : tree_.closestPoints(queries_mm))
    distances_mm.push_back(closest.distance_mm);
  return distances_mm;
}

}  // namespace softscope
