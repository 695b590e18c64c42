// eval/simulation/cut_path.h: a straight line over a surface, as edges of it.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "eval/simulation/splitting_mesh.h"

namespace softscope {

/// The plane that a blade moves in, and where it enters.
struct CutPlane {
  Eigen::Vector3f middle_mm;  // on the surface
  Eigen::Vector3f along;      // unit, across `out`
  Eigen::Vector3f out;        // unit, of the surface around the middle
  double length_mm = 0;       // along the surface

  Eigen::Vector3f left() const { return out.cross(along); }
};

/// Vertices one after the other, each joined with the next by an edge.
struct CutPath {
  std::vector<std::int32_t> vertices;
  std::vector<double> along_mm;  // of each, from the middle: -length / 2 to length / 2
};

/// Splits triangles around the middle until their edges are no longer than `longest_mm`.
void refineAround(SplittingMesh& mesh, const CutPlane& plane, double longest_mm);

/// Splits the surface along the plane, as far as the cut goes. A vertex nearer to the plane than a
/// twelfth of an edge counts as on it. Throws OptionError where the surface turns away or the line
/// comes back to itself, InputError where it meets an open edge.
CutPath layPath(SplittingMesh& mesh, const CutPlane& plane);

}  // namespace softscope
