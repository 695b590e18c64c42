// toolkit/comparison/compare_map.cpp: decimation of both surfaces, and the initial view direction.
#include "toolkit/comparison/compare_map.h"

#include <cmath>

#include "mesh/coarse_mesh.h"
#include "toolkit/comparison/compare_picture.h"

namespace softscope {
namespace {

constexpr std::size_t kMostTestPoints = 60000, kMostReferencePoints = 8000;

/// Every n-th point of a point cloud; a decimated surface of a mesh.
CoarseMesh decimated(const TriangleMesh& test) {
  const std::size_t count = test.vertices_mm.size();
  if (!test.empty() || count <= kMostTestPoints) return coarsen(test, kMostTestPoints);
  CoarseMesh points;
  for (std::size_t k = 0; k < kMostTestPoints; ++k)
    points.vertices.push_back(static_cast<std::int32_t>(k * count / kMostTestPoints));
  return points;
}

}  // namespace

ErrorMap comparisonMap(const ComparisonResult& result, const TriangleMesh& reference,
                       const TriangleMesh& test) {
  ErrorMap map;
  const CoarseMesh shown = decimated(test);
  map.surface = shown.at(test.vertices_mm);
  map.surface.space = reference.space;
  for (const std::int32_t vertex : shown.vertices) {
    const ClosestPoint& closest = result.comparison.closest[static_cast<std::size_t>(vertex)];
    map.absolute_mm.push_back(static_cast<float>(closest.distance_mm));
    map.signed_mm.push_back(static_cast<float>(closest.signed_distance_mm));
  }
  map.reference = coarsen(reference, kMostReferencePoints).at(reference.vertices_mm);
  const Eigen::Vector3d eye = comparisonEye(reference, result.comparison.closest);
  map.look = -eye.normalized().cast<float>();
  // Up is the patient's head; for a view along that axis, the camera's up direction.
  if (std::abs(map.look.z()) > 0.9f) map.up = {0, -1, 0};
  return map;
}

}  // namespace softscope
