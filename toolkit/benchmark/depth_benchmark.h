// toolkit/benchmark/depth_benchmark.h: depth benchmarks of SCARED and
// SERV-CT.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/depth_scores.h"

namespace softscope {

/// Runs `depth` on each keyframe of SCARED, then writes OUT/benchmark.json. Complete
/// pairs are not repeated. A failed pair is excluded and named; if all fail: InputError.
DepthBenchmarkResult benchmarkScared(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope,
                                     const Progress& progress = {});

/// The same for the pairs of SERV-CT, against
/// Reference_CT, or Reference_RGB if there is no CT.
DepthBenchmarkResult benchmarkServCt(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope,
                                     const Progress& progress = {});

}  // namespace softscope
