// eval/simulation/wound/plane_split.h: a surface, split where a plane meets it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "eval/simulation/wound/splitting_mesh.h"

namespace softscope {

/// The plane that a blade moves in, and where it enters.
struct IncisionPlane {
  Eigen::Vector3f middle_mm;  // on the surface
  Eigen::Vector3f along;      // unit, across `out`
  Eigen::Vector3f out;        // unit, of the surface around the middle
  double length_mm = 0;       // along the surface

  Eigen::Vector3f left() const { return out.cross(along); }
};

/// Splits triangles around the middle until their edges are no longer than `longest_mm`.
void refineAround(SplittingMesh& mesh, const IncisionPlane& plane, double longest_mm);

/// How near to its end an edge counts as met there: a share of it.
inline constexpr float kSnapShare = 1.0F / 12;

/// Neighbours on the plane, of each vertex on it.
using PlaneLines = std::map<std::int32_t, std::vector<std::int32_t>>;

/// Splits the edges around the middle that the plane meets. A vertex nearer to it than kSnapShare
/// of an edge counts as on it. Throws InputError where it meets an open edge.
PlaneLines splitByPlane(SplittingMesh& mesh, const IncisionPlane& plane);

}  // namespace softscope
