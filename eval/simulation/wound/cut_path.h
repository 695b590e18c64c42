// eval/simulation/wound/cut_path.h: straight line on a surface as edges of the mesh.
#pragma once

#include <vector>

#include "eval/simulation/wound/plane_split.h"

namespace softscope {

/// Sequence of vertices connected by edges.
struct CutPath {
  std::vector<std::int32_t> vertices;
  std::vector<double> along_mm;  // per vertex, from the centre: -length / 2 to length / 2
};

/// Splits the surface along the plane and follows the intersection
/// for the length of the cut. Throws OptionError if the surface
/// turns away or the line is closed, InputError at an open edge.
CutPath layPath(SplittingMesh& mesh, const IncisionPlane& plane);

}  // namespace softscope
