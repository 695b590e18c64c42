// toolkit/benchmark/stir_scores.h: table of the STIR 2026 benchmark.
#pragma once

#include <string>
#include <vector>

#include "eval/motion/tracking_scores.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

inline constexpr int kStirWarmUpFrames = 10;  // excluded from the latency

/// Scores of one clip, for the predictions and for the control (constant first true position).
struct StirClipResult {
  std::string name;
  std::string excluded;  // reason; empty for a clip that counts
  std::vector<JudgedPoint> points_mm, control_mm, points_px, control_px;
  std::vector<double> error_mm;    // measured points of all frames with a pose
  std::vector<double> latency_ms;  // without the first ten frames
  std::size_t extrapolated = 0;    // predictions without a measured track
};

struct StirBenchmarkResult {
  std::vector<StirClipResult> clips;
  bool stopped = false;
};

/// The official table with the control's row, protocol, exclusions, intervals, latency.
FactSheet stirBenchmarkFacts(const StirBenchmarkResult& result);

}  // namespace softscope
