// src/deform/solver/lm_solver.h: Levenberg-Marquardt solver of the warp of one frame.
#pragma once

#include <memory>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"
#include "deform/solver/deform_summary.h"
#include "deform/solver/warp_system.h"

namespace softscope {

/// Levenberg-Marquardt over the nodes' transforms: docs/energy.md (16) to (19). Holds what can be
/// reused from frame to frame: the sparsity pattern and its elimination order.
class DeformSolver {
 public:
  virtual ~DeformSolver() = default;
  virtual NodeModel nodeModel() const = 0;
  /// May do ahead what needs the graph's structure alone. Results don't depend on it.
  virtual void prepare(const WarpGraph& /*graph*/) {}
  /// Starts from graph->transforms (the identity after rebase()) and changes nothing else.
  virtual DeformSummary solve(const PointModel& model, const DeformObservation& seen,
                              WarpGraph* graph) = 0;
};

/// On the processor. Throws OptionError where the options contradict themselves.
std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options);

/// With a system for the same options.
std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options,
                                               std::unique_ptr<WarpSystem> system);

}  // namespace softscope
