// toolkit/benchmark/stir_benchmark.h: STIR 2026: clips to predictions, predictions to the table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/stir_scores.h"

namespace softscope {

/// Runs `reconstruct` on each clip, then writes OUT/preds.json, OUT/benchmark.json. Clips whose run
/// is complete are not run again. A clip that fails is excluded and named; all that fail:
/// InputError.
StirBenchmarkResult benchmarkStir(const BenchmarkOptions& options,
                                  const RunSoftscope& run_softscope, const Progress& progress = {});

}  // namespace softscope
