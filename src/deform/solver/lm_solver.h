// src/deform/solver/lm_solver.h: Levenberg-Marquardt solver of the warp of one frame.
#pragma once

#include <memory>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"
#include "deform/solver/deform_summary.h"
#include "deform/solver/warp_system.h"

namespace softscope {

/// Levenberg-Marquardt over the transforms of the nodes: docs/energy.md (16) to
/// (19). Keeps reusable data between frames: sparsity pattern and elimination order.
class DeformSolver {
 public:
  virtual ~DeformSolver() = default;
  virtual NodeModel nodeModel() const = 0;
  /// May compute in advance what depends on the structure only. Results do not depend on it.
  virtual void prepare(const WarpGraph& /*graph*/) {}
  /// Starts from graph->transforms (the identity after rebase()) and changes nothing else.
  virtual DeformSummary solve(const PointModel& model, const DeformObservation& seen,
                              WarpGraph* graph) = 0;
};

/// On the CPU. Throws OptionError for contradictory options.
std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options);

/// With a system for the same options.
std::unique_ptr<DeformSolver> makeDeformSolver(const DeformOptions& options,
                                               std::unique_ptr<WarpSystem> system);

}  // namespace softscope
