// toolkit/benchmark/surgt_scores.h: SurgT's table, of tracks of boxes that were judged.
#pragma once

#include <string>
#include <vector>

#include "eval/motion/box_tracking.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// A tracker's scores in one video.
struct SurgtVideoScores {
  std::vector<BoxScores> targets;             // of each target, its starts merged
  std::vector<std::vector<double>> overlaps;  // of each target: overlapCurve()
};

struct SurgtClipResult {
  std::string name;
  std::string excluded;  // why; empty where it counts
  SurgtVideoScores found, control;
  int starts = 0;          // of trackers, over all targets
  int missing_starts = 0;  // whose run failed: judged as no estimate at all
  std::size_t boxes = 0;   // estimates given
  std::size_t frames = 0;  // judged frames of all starts
  std::vector<double> latency_ms;
};

struct SurgtBenchmarkResult {
  std::vector<SurgtClipResult> clips;
  bool stopped = false;
};

/// The official table with the control's row, protocol, exclusions, coverage, intervals, latency.
FactSheet surgtBenchmarkFacts(const SurgtBenchmarkResult& result);

}  // namespace softscope
