// src/deform/solver/warp_system.h: the least-squares problem of one frame, on the processor or a
// device.
#pragma once

#include <optional>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"
#include "deform/solver/deform_summary.h"

namespace softscope {

/// The energy after a new association.
struct AssociatedEnergy {
  EnergySums energy;
  int points = 0;            // with a target plane
  bool constrained = false;  // at least one point or match
};

/// A step from the accepted transforms, and the energy after it.
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
  /// The part that depends on the graph's structure alone. Repeated calls cost little.
  virtual void analyse(const WarpGraph& graph) = 0;
  /// Takes the observation of a frame, and the graph's transforms as accepted. `seen` must live
  /// until the next begin().
  virtual MatchCounts begin(const PointModel& model, const DeformObservation& seen,
                            const WarpGraph& graph) = 0;
  /// New target planes at the accepted transforms: docs/energy.md (8) to (11).
  virtual AssociatedEnergy associate() = 0;
  /// For each node, 1 where a point or a match of the last association constrains it.
  virtual std::vector<char> constrainedNodes() = 0;
  /// The normal equations at the accepted transforms: docs/energy.md (16).
  virtual void assemble() = 0;
  /// Solves (H + lambda D) step = -g: docs/energy.md (17). No value where that is not positive
  /// definite or not finite.
  virtual std::optional<TrialStep> tryStep(double damping) = 0;
  /// The last trial's transforms become the accepted ones.
  virtual void acceptStep() = 0;
  /// Smallest to largest pivot of the last factorisation.
  virtual double pivotRatio() = 0;
  virtual std::vector<NodeTransform> transforms() = 0;
  /// Milliseconds since begin(), by part.
  virtual DeformTimes times() const = 0;
};

}  // namespace softscope
