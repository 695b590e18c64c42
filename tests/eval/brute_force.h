// tests/eval/brute_force.h: the slow truth about distances, by other formulas than eval's.
#pragma once

#include <Eigen/Core>

#include "core/triangle_mesh.h"

namespace softscope {

/// Minimum distance, mm, to all triangles of the mesh, in double: the
/// foot on the plane of each triangle, the edges if that is outside.
double bruteForceDistance(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm);

/// How often the surface winds around the point: 1 inside, 0 outside of a closed surface
/// (solid angles by Van Oosterom and Strackee, 1983).
double windingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point_mm);

}  // namespace softscope
