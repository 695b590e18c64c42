// eval/simulation/wound/plane_split.h: surface split along a plane.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "eval/simulation/wound/splitting_mesh.h"

namespace softscope {

/// Plane of the blade, with its entry point.
struct IncisionPlane {
  Eigen::Vector3f middle_mm;  // on the surface
  Eigen::Vector3f along;      // unit vector perpendicular to `out`
  Eigen::Vector3f out;        // mean unit normal of the surface at the centre
  double length_mm = 0;       // along the surface

  Eigen::Vector3f left() const { return out.cross(along); }
};

/// Splits triangles around the centre until their edges are at most `longest_mm`.
void refineAround(SplittingMesh& mesh, const IncisionPlane& plane, double longest_mm);

/// Tolerance at the end of an edge, as a share of its length.
inline constexpr float kSnapShare = 1.0F / 12;

/// Neighbours on the plane, per vertex on it.
using PlaneLines = std::map<std::int32_t, std::vector<std::int32_t>>;

/// Splits the edges around the centre that intersect the plane. A vertex within
/// kSnapShare of an edge counts as on the plane. Throws InputError at an open edge.
PlaneLines splitByPlane(SplittingMesh& mesh, const IncisionPlane& plane);

}  // namespace softscope
