// src/deform/energy/stiffness.h: how stiff the tissue is taken to be, from the matches of a frame:
// docs/energy.md (7c).
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/constraints.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// What the matches say of the deformation of a frame before any warp, relative to their standard
/// errors.
struct MatchedStrain {
  std::vector<double> edges_square;  // of the surroundings of each edge, noise subtracted
  double noise_square = 0;           // of a match, about the median of those of its node
  int edges = 0;                     // with enough matches at both ends
};

/// Matches of a node: those whose strongest node it is. Sources are taken as they are: transforms
/// of the graph are those of rebase().
MatchedStrain strainOfMatches(const PointModel& model, const WarpGraph& graph,
                              const CarriedMatches& carried);

/// Factor of w_reg of each edge; 1 where edges are few.
std::vector<double> stiffnessOf(const MatchedStrain& strain);

/// Multiplies the stiffness of each edge, if the options follow the tissue.
void followTissue(const DeformOptions& options, const PointModel& model, const WarpGraph& graph,
                  const CarriedMatches& carried, ConstraintSet* constraints);

}  // namespace softscope
