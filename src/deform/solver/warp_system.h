// src/deform/solver/warp_system.h: least-squares problem of one frame, on the CPU or a
// device.
#pragma once

#include <optional>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/stiffness.h"
#include "deform/options/deform_options.h"
#include "deform/solver/deform_summary.h"

namespace softscope {

/// Energy after a new association.
struct AssociatedEnergy {
  EnergySums energy;
  int points = 0;            // with a target plane
  bool constrained = false;  // at least one point or match
};

/// Step from the accepted transforms, and the energy after it.
struct TrialStep {
  double predicted_decrease = 0;  // docs/energy.md (18)
  double furthest_mm = 0;         // displacement of a node, or of a point one edge away from it
  EnergySums energy;
};

/// Residuals, normal equations and transforms of one frame. WarpSolver (lm_solver.cpp) decides
/// which step is accepted.
class WarpSystem {
 public:
  virtual ~WarpSystem() = default;
  /// Depends on the structure of the graph only. Repeated calls are fast.
  virtual void analyse(const WarpGraph& graph) = 0;
  /// Sets the observation of a frame, and the accepted transforms from the graph. `seen` and
  /// `graph` must live until the last call for the frame, besides times().
  virtual MatchCounts begin(const PointModel& model, const DeformObservation& seen,
                            const WarpGraph& graph) = 0;
  /// New target planes at the accepted transforms: docs/energy.md (8) to (11).
  virtual AssociatedEnergy associate() = 0;
  /// Per node, 1 if a point or a match of the last association constrains it.
  virtual std::vector<char> constrainedNodes() = 0;
  /// The normal equations at the accepted transforms: docs/energy.md (16).
  virtual void assemble() = 0;
  /// Solves (H + lambda D) step = -g: docs/energy.md
  /// (17). Empty unless positive definite and finite.
  virtual std::optional<TrialStep> tryStep(double damping) = 0;
  /// Accepts the transforms of the last trial.
  virtual void acceptStep() = 0;
  /// Smallest to largest pivot of the last factorisation.
  virtual double pivotRatio() = 0;
  virtual std::vector<NodeTransform> transforms() = 0;
  /// Milliseconds since begin(), by part.
  virtual DeformTimes times() const = 0;
};

}  // namespace softscope
