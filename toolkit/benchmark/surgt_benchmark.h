// toolkit/benchmark/surgt_benchmark.h: SurgT benchmark: bounding box tracks, and their table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/surgt_scores.h"

namespace softscope {

/// Runs `reconstruct` from each start of each video (every 50 frames, or the next frame with a
/// true box), tracks pixels of the box, and writes OUT/benchmark.json. Complete runs are not
/// repeated. Videos that cannot be evaluated are excluded and named; all of them: InputError.
SurgtBenchmarkResult benchmarkSurgt(const BenchmarkOptions& options,
                                    const RunSoftscope& run_softscope,
                                    const Progress& progress = {});

}  // namespace softscope
