// toolkit/benchmark/surgt_benchmark.h: SurgT: videos to tracked boxes, boxes to the table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/surgt_scores.h"

namespace softscope {

/// Runs `reconstruct` from each start of each video (every 50 frames, the next with a usable true
/// box), follows pixels of the true box, and writes OUT/benchmark.json. Runs that are complete are
/// not run again. A video that can't be judged is excluded and named; all of them: InputError.
SurgtBenchmarkResult benchmarkSurgt(const BenchmarkOptions& options,
                                    const RunSoftscope& run_softscope,
                                    const Progress& progress = {});

}  // namespace softscope
