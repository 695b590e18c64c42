// src/deform/solver/deform_summary.h: input and result of the solution of one frame.
#pragma once

#include <string>
#include <vector>

#include "deform/energy/constraints.h"
#include "deform/energy/energy.h"
#include "deform/energy/surface_target.h"

namespace softscope {

/// Observation of a frame. World frame, mm; refers to data of the caller.
struct DeformObservation {
  const SurfaceTarget* surface = nullptr;     // live surface; nullptr = matches only
  const std::vector<int>* visible = nullptr;  // model points of the data term; nullptr = all
  std::vector<KeyPointMatch> matches;
  bool after_gap = false;  // frames before were not fused: tissue may have moved far
};

enum class StopReason {
  kConverged,       // the last step moved no node, or hardly lowered the cost
  kIterationLimit,  // still improving
  kNoBetterStep,    // no step size lowers the cost
  kNothingToFit,    // no bound visible point, no match; or no node
  kNotFinite,       // graph or result contains NaN; transforms are unchanged
};

const char* toString(StopReason reason);

/// Milliseconds of one solve, by part.
struct DeformTimes {
  double prepare_ms = 0;  // candidates, and the symbolic part where the graph has changed
  double associate_ms = 0;
  double evaluate_ms = 0;
  double assemble_ms = 0;
  double factor_ms = 0;  // and solve
};

/// Result of the solver. Missing convergence is a value, not an exception.
struct DeformSummary {
  StopReason reason = StopReason::kNothingToFit;
  bool converged() const { return reason == StopReason::kConverged; }
  int iterations = 0;                       // accepted steps
  int rejections = 0;                       // steps that would raise the cost
  EnergyTerms before;                       // at the initial transforms, with the first association
  EnergyTerms after;                        // at the final transforms, with the last association
  int points_before = 0, points_after = 0;  // with a target plane
  double data_mean_mm_before = 0, data_mean_mm_after = 0;  // mean |point to plane| of these
  int matches = 0, matches_dropped = 0;
  int nodes_without_data = 0;       // no point, no match: determined by their neighbours
  int components_without_data = 0;  // unconstrained components of the graph: unchanged
  double damping = 0;               // lambda at the end
  double pivot_ratio = 1;           // smallest to largest pivot of the last factor, see the warning
  double last_step_mm = 0;          // largest node displacement in the last accepted step
  std::vector<double> costs;        // before and after each accepted step, pairwise
  std::vector<std::string> warnings;
  DeformTimes times;
};

struct MatchCounts {
  int used = 0;
  int dropped = 0;  // not finite, or with an unbound model point
};

}  // namespace softscope
