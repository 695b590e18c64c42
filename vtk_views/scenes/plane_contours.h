// vtk_views/scenes/plane_contours.h: contours of a surface in a plane.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// All points p with normal · (p − point) = 0; `normal` of unit length.
struct SectionPlane {
  Eigen::Vector3d point_mm;
  Eigen::Vector3d normal;
};

/// Points along the contour, mm; a closed line repeats its first point.
using ContourLine = std::vector<Eigen::Vector3f>;

/// Tests every triangle, without a tree: 1 ms for 99 k triangles. A vertex in
/// the plane counts as above it, so closed surfaces always give closed lines.
std::vector<ContourLine> planeContours(const TriangleMesh& mesh, const SectionPlane& plane);

/// One list of lines per plane, in parallel.
std::vector<std::vector<ContourLine>> planeContours(const TriangleMesh& mesh,
                                                    const std::vector<SectionPlane>& planes);

/// The vertices within `reach_mm` of the plane.
std::vector<Eigen::Vector3f> pointsNearPlane(const std::vector<Eigen::Vector3f>& points_mm,
                                             const SectionPlane& plane, double reach_mm);

}  // namespace softscope
