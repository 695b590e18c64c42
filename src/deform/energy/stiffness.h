// src/deform/energy/stiffness.h: how stiff the tissue is taken to be, from the first step of a
// frame: docs/energy.md (7c).
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/energy/constraints.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Share of w_reg and w_rest in the first step, when neither noise nor deformation are known.
constexpr double kFirstStiffness = 0.2;

/// What the first step leaves of matches and edges.
struct FirstFit {
  std::vector<float> matches_mm;         // size of each match (12)
  std::vector<double> edges_square_mm2;  // of edges between visible nodes: (6), with their weights
};

/// Of each edge, without its weight, with these transforms in place of those of the graph.
std::vector<double> edgeEnergies(const WarpGraph& graph,
                                 const std::vector<NodeTransform>& transforms,
                                 const std::vector<ExpectedOffsets>& expected);

/// FirstFit::edges_square_mm2 from these energies.
std::vector<double> squaresOfSeenEdges(const WarpGraph& graph, const std::vector<double>& energies,
                                       const ConstraintSet& constraints);

/// Factor of w_reg and w_rest in the steps after the first one; 1 where matches or edges are few.
double stiffnessAfter(const FirstFit& fit);

/// With these weights multiplied by it.
DeformOptions stiffer(const DeformOptions& options, double factor);

}  // namespace softscope
