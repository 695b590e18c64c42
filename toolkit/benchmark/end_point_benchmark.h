// toolkit/benchmark/end_point_benchmark.h: STIR to 2025: tattoos of the first image to the last
// one.
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
  std::string excluded;                      // why; empty where it counts
  std::vector<double> found_px, control_px;  // distance from the nearest true end point
  int points = 0;                            // of the first image
  int measured = 0;  // of these, with a position in the last frame; the others stay
  std::vector<double> latency_ms;
};

struct EndPointBenchmarkResult {
  std::vector<EndPointClipResult> clips;
  bool stopped = false;
};

/// Centres of the bounding boxes of connected (8 neighbours) non-zero parts, px.
std::vector<Eigen::Vector2d> markCentres(const Mask& marks);

/// Runs `reconstruct` on each sequence with the tattoos of icgstartseg.png as --track, then writes
/// OUT/benchmark.json. Sequences that are done are not run again. One that fails is excluded and
/// named; all of them: InputError.
EndPointBenchmarkResult benchmarkStirEnds(const BenchmarkOptions& options,
                                          const RunSoftscope& run_softscope,
                                          const Progress& progress = {});

/// delta_avg in the left image, with control, protocol, exclusions, coverage, intervals, latency.
FactSheet endPointFacts(const EndPointBenchmarkResult& result);

}  // namespace softscope
