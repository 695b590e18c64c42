// toolkit/benchmark/c3vd_benchmark.h: trajectory and depth benchmark of C3VD.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/c3vd_scores.h"

namespace softscope {

/// Runs `reconstruct --hold-out 8` on each sequence, then writes OUT/benchmark.json. The depth of
/// each held-out frame is that of the model of the previous frame, drawn from the pose of that
/// frame moved by the true motion to the held-out one. Complete sequences are not repeated. A
/// failed sequence is excluded and named; if all fail: InputError.
C3vdBenchmarkResult benchmarkC3vd(const BenchmarkOptions& options,
                                  const RunSoftscope& run_softscope, const Progress& progress = {});

}  // namespace softscope
