// toolkit/benchmark/path_benchmark.h: StereoMIS: films to the scope's path, paths to the table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/path_scores.h"

namespace softscope {

/// Runs `reconstruct --frames START:END` on each range of each sequence, then writes
/// OUT/benchmark.json. Ranges that are done are not run again. A range that fails is excluded and
/// named; all of them: InputError.
PathBenchmarkResult benchmarkStereoMis(const BenchmarkOptions& options,
                                       const RunSoftscope& run_softscope,
                                       const Progress& progress = {});

}  // namespace softscope
