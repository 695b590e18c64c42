// toolkit/benchmark/end_point_scores.h: table of the benchmark of STIR up to 2025.
#pragma once

#include <string>
#include <vector>

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct EndPointClipResult {
  std::string name;
  std::string excluded;  // reason; empty for a sequence that counts
  // Distances to the nearest true end point: in the left image, and in 3-D for points whose tattoo
  // has a partner in the first right image.
  std::vector<double> found_px, control_px, found_mm, control_mm;
  std::string without_3d;  // reason; empty for a sequence with a 3-D score
  int points = 0;          // in the first image
  int measured = 0;  // with a position in the last frame; the others keep their first position
  std::vector<double> latency_ms;
};

struct EndPointBenchmarkResult {
  std::vector<EndPointClipResult> clips;
  bool stopped = false;
};

/// delta_avg in the left image and in 3-D, with control, protocol, exclusions, coverage, intervals,
/// latency.
FactSheet endPointFacts(const EndPointBenchmarkResult& result);

}  // namespace softscope
