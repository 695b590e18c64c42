// toolkit/benchmark/path_benchmark.h: trajectory benchmark of StereoMIS.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/path_scores.h"

namespace softscope {

/// Runs `reconstruct --frames START:END` on each range of each sequence,
/// then writes OUT/benchmark.json. Complete ranges are not repeated. A
/// failed range is excluded and named; if all fail: InputError.
PathBenchmarkResult benchmarkStereoMis(const BenchmarkOptions& options,
                                       const RunSoftscope& run_softscope,
                                       const Progress& progress = {});

}  // namespace softscope
