// src/deform/energy/stiffness.h: how stiff the tissue is taken to be, from the matches of a frame:
// docs/energy.md (7c).
#pragma once

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
MatchedStrain strainOfMatches(const WarpGraph& graph, const CarriedMatches& carried);

/// Factor of w_reg; 1 where edges are few.
double stiffnessOf(const MatchedStrain& strain);

/// The same from the matches; 1 if the options do not follow the tissue.
double tissueStiffness(const DeformOptions& options, const WarpGraph& graph,
                       const CarriedMatches& carried);

}  // namespace softscope
