// toolkit/benchmark/depth_benchmark.h: SCARED and SERV-CT: stereo pairs to depth, depth to the
// table.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/depth_scores.h"

namespace softscope {

/// Runs `depth` on each keyframe of SCARED, then writes OUT/benchmark.json. Pairs that are done are
/// not run again. A pair that fails is excluded and named; all of them: InputError.
DepthBenchmarkResult benchmarkScared(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope,
                                     const Progress& progress = {});

/// The same of each pair of SERV-CT's experiments, against Reference_CT, where that is missing
/// Reference_RGB.
DepthBenchmarkResult benchmarkServCt(const BenchmarkOptions& options,
                                     const RunSoftscope& run_softscope,
                                     const Progress& progress = {});

}  // namespace softscope
