// toolkit/benchmark/stir_scores.h: STIR 2026's table, of points that were judged.
#pragma once

#include <string>
#include <vector>

#include "eval/motion/tracking_scores.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

inline constexpr int kStirWarmUpFrames = 10;  // whose latency is left out

/// One clip's scores, of predictions and of the control, which stays where the truth begins.
struct StirClipResult {
  std::string name;
  std::string excluded;  // why; empty where it counts
  std::vector<JudgedPoint> points_mm, control_mm, points_px, control_px;
  std::vector<double> error_mm;    // of measured points in frames with a pose, all frames
  std::vector<double> latency_ms;  // without the first ten frames
  std::size_t extrapolated = 0;    // predictions that no track measured
};

struct StirBenchmarkResult {
  std::vector<StirClipResult> clips;
  bool stopped = false;
};

/// The official table with the control's row, protocol, exclusions, intervals, latency.
FactSheet stirBenchmarkFacts(const StirBenchmarkResult& result);

}  // namespace softscope
