// src/deform/solver/deform_summary.h: observation and result of one search for a warp.
#pragma once

#include <string>
#include <vector>

#include "deform/energy/constraints.h"
#include "deform/energy/energy.h"
#include "deform/energy/surface_target.h"

namespace softscope {

/// Observation of a frame. World frame, mm; refers to the caller's data.
struct DeformObservation {
  const SurfaceTarget* surface = nullptr;     // the live surface; nullptr = matches alone
  const std::vector<int>* visible = nullptr;  // model points that it may pull; nullptr = all
  std::vector<KeyPointMatch> matches;
};

enum class StopReason {
  kConverged,       // the last step moved no node, or lowered the cost by next to nothing
  kIterationLimit,  // still improving
  kNoBetterStep,    // however small the step, the cost did not fall
  kNothingToFit,    // no bound visible point, no match; or no node
  kNotFinite,       // the graph or the result holds NaN; the transforms are as they were
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

/// What became of the search. Not converging is a value, never an exception.
struct DeformSummary {
  StopReason reason = StopReason::kNothingToFit;
  bool converged() const { return reason == StopReason::kConverged; }
  int iterations = 0;  // accepted steps
  int rejections = 0;  // steps that would have raised the cost
  EnergyTerms before;  // at the transforms that came in, with the first association
  EnergyTerms after;   // at the transforms that went out, with the last association
  int points_before = 0, points_after = 0;                 // that the surface pulled
  double data_mean_mm_before = 0, data_mean_mm_after = 0;  // mean |point to plane| of those
  int matches = 0, matches_dropped = 0;
  int nodes_without_data = 0;       // no point, no match: their neighbours carry them
  int components_without_data = 0;  // connected parts of the graph that nothing pulls: they stay
  double damping = 0;               // lambda at the end
  double pivot_ratio = 1;           // smallest to largest pivot of the last factor, see the warning
  double last_step_mm = 0;          // the furthest that a node moved in the last accepted step
  std::vector<double> costs;        // before each accepted step and after it, pairwise
  std::vector<std::string> warnings;
  DeformTimes times;
};

struct MatchCounts {
  int used = 0;
  int dropped = 0;  // not finite, or their model point unbound
};

}  // namespace softscope
