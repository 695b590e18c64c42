// toolkit/benchmark/stir_benchmark.h: STIR 2026 benchmark: predictions of all clips, and table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/stir_scores.h"

namespace softscope {

/// Runs `reconstruct` on each clip, then writes OUT/preds.json
/// and OUT/benchmark.json. Complete clips are not repeated. A
/// failed clip is excluded and named; if all fail: InputError.
StirBenchmarkResult benchmarkStir(const BenchmarkOptions& options,
                                  const RunSoftscope& run_softscope, const Progress& progress = {});

}  // namespace softscope
