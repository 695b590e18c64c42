// eval/simulation/wound/wound_walls.h: two lips along a path, with the walls between them.
#pragma once

#include <vector>

#include "eval/simulation/tissue/tissue_body.h"
#include "eval/simulation/wound/cut_path.h"

namespace softscope {

/// Duplicates the inner vertices of the path, so that each lip has its own, and adds one
/// wall per lip; both walls meet `depths_mm` below the path. The open wound is a rounded
/// V across, and a lens of `opening_mm` along. `mesh`: `organ` split along the path.
TissueBody openWound(const TriangleMesh& organ, const SplittingMesh& mesh,
                     const IncisionPlane& plane, const CutPath& path,
                     const std::vector<double>& depths_mm, double opening_mm);

}  // namespace softscope
