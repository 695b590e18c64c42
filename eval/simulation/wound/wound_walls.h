// eval/simulation/wound/wound_walls.h: two lips where one line was, and what lies between them.
#pragma once

#include <vector>

#include "eval/simulation/tissue/tissue_body.h"
#include "eval/simulation/wound/cut_path.h"

namespace softscope {

/// Doubles the path's inner vertices, so that each lip has its own, and hangs a wall on each lip;
/// the two meet `depths_mm` below the path. Across, the open wound is a rounded V; along, a lens of
/// `opening_mm` in its middle. `mesh`: of `organ`, split along the path.
TissueBody openWound(const TriangleMesh& organ, const SplittingMesh& mesh,
                     const IncisionPlane& plane, const CutPath& path,
                     const std::vector<double>& depths_mm, double opening_mm);

}  // namespace softscope
