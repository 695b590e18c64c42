// src/deform/energy/stiffness.h: how stiff the tissue is taken to be, from the matches of a frame:
// docs/energy.md (7c).
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/constraints.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// What the matches say of the deformation of a frame before any warp, both relative to their
/// standard errors.
struct MatchedStrain {
  double edges_square = 0;  // mean over edges with enough matches at both ends, noise subtracted
  double noise_square = 0;  // of a match, about the median of those of its node
  int edges = 0;
};

/// Matches of a node: those whose strongest node it is. Sources are taken as they are: transforms
/// of the graph are those of rebase().
MatchedStrain strainOfMatches(const PointModel& model, const WarpGraph& graph,
                              const std::vector<KeyPointMatch>& matches);

/// Factor of w_reg and w_rest; 1 where edges are few.
double stiffnessOf(const MatchedStrain& strain);

/// With these weights multiplied by it.
DeformOptions stiffer(const DeformOptions& options, double factor);

}  // namespace softscope
