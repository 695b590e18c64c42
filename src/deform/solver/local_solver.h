// src/deform/solver/local_solver.h: the warp of a large graph, solved around the tissue in sight.
#pragma once

#include <memory>

#include "deform/solver/lm_solver.h"

namespace softscope {

/// Which nodes of a large graph are solved for: those within a distance of visible tissue and
/// matches, along edges, in node spacings. Once chosen, they are kept while all nodes within
/// kLeast are among them and none beyond kMost, since a choice costs a new order of elimination.
struct LocalRule {
  static constexpr std::size_t kWholeUpTo = 600;  // nodes: such a graph is solved as a whole
  static constexpr double kLeast = 8, kChosen = 10, kMost = 12;
};

/// Solves with `whole`, around visible tissue only where the graph is large: docs/energy.md, "Large
/// graphs". Sets WarpGraph::afar.
std::unique_ptr<DeformSolver> makeLocalSolver(std::unique_ptr<DeformSolver> whole,
                                              double node_spacing_mm);

}  // namespace softscope
