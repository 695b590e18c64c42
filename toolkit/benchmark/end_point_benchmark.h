// toolkit/benchmark/end_point_benchmark.h: benchmark of STIR
// up to 2025: positions of the tattoos in the last image.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/image.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct EndPointClipResult {
  std::string name;
  std::string excluded;                      // reason; empty for a sequence that counts
  std::vector<double> found_px, control_px;  // distance to the nearest true end point
  int points = 0;                            // in the first image
  int measured = 0;  // with a position in the last frame; the others keep their first position
  std::vector<double> latency_ms;
};

struct EndPointBenchmarkResult {
  std::vector<EndPointClipResult> clips;
  bool stopped = false;
};

/// Centres of the bounding boxes of connected (8 neighbours) non-zero parts, px.
std::vector<Eigen::Vector2d> markCentres(const Mask& marks);

/// Runs `reconstruct` on each sequence with the tattoos of icgstartseg.png as
/// --track, then writes OUT/benchmark.json. Complete sequences are not
/// repeated. A failed sequence is excluded and named; if all fail: InputError.
EndPointBenchmarkResult benchmarkStirEnds(const BenchmarkOptions& options,
                                          const RunSoftscope& run_softscope,
                                          const Progress& progress = {});

/// delta_avg in the left image, with control, protocol, exclusions, coverage, intervals, latency.
FactSheet endPointFacts(const EndPointBenchmarkResult& result);

}  // namespace softscope
