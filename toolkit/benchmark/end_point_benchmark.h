// toolkit/benchmark/end_point_benchmark.h: benchmark of STIR
// up to 2025: positions of the tattoos in the last image.
#pragma once

#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/benchmark/end_point_scores.h"

namespace softscope {

/// Runs `reconstruct` on each sequence with the tattoos of icgstartseg.png as
/// --track, then writes OUT/benchmark.json. Complete sequences are not
/// repeated. A failed sequence is excluded and named; if all fail: InputError.
/// A sequence without true positions in 3-D has no 3-D score, and is named.
EndPointBenchmarkResult benchmarkStirEnds(const BenchmarkOptions& options,
                                          const RunSoftscope& run_softscope,
                                          const Progress& progress = {});

}  // namespace softscope
