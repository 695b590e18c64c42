// toolkit/benchmark/surgt_scores.h: table of the SurgT benchmark.
#pragma once

#include <string>
#include <vector>

#include "eval/motion/box_tracking.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Scores of a tracker in one video.
struct SurgtVideoScores {
  std::vector<BoxScores> targets;             // per target; its starts are merged
  std::vector<std::vector<double>> overlaps;  // per target: overlapCurve()
};

struct SurgtClipResult {
  std::string name;
  std::string excluded;  // reason; empty for a video that counts
  SurgtVideoScores found, control;
  int starts = 0;          // start frames over all targets
  int missing_starts = 0;  // failed runs: evaluated as missing estimates
  std::size_t boxes = 0;   // estimated boxes
  std::size_t frames = 0;  // evaluated frames over all starts
  std::vector<double> latency_ms;
};

struct SurgtBenchmarkResult {
  std::vector<SurgtClipResult> clips;
  bool stopped = false;
};

/// The official table with the control's row, protocol, exclusions, coverage, intervals, latency.
FactSheet surgtBenchmarkFacts(const SurgtBenchmarkResult& result);

}  // namespace softscope
