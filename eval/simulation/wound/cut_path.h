// eval/simulation/wound/cut_path.h: a straight line over a surface, as edges of the mesh.
#pragma once

#include <vector>

#include "eval/simulation/wound/plane_split.h"

namespace softscope {

/// Vertices one after the other, each joined with the next by an edge.
struct CutPath {
  std::vector<std::int32_t> vertices;
  std::vector<double> along_mm;  // of each, from the middle: -length / 2 to length / 2
};

/// Splits the surface by the plane and follows that line as far as the cut goes. Throws OptionError
/// where the surface turns away or the line comes back to itself, InputError where it meets an open
/// edge.
CutPath layPath(SplittingMesh& mesh, const IncisionPlane& plane);

}  // namespace softscope
