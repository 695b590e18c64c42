// toolkit/benchmark/c3vd_scores.h: table of the C3VD benchmark.
#pragma once

#include <vector>

#include "eval/images/depth_errors.h"
#include "toolkit/benchmark/path_scores.h"

namespace softscope {

/// Errors per held-out frame.
struct HeldOutDepths {
  std::vector<DepthErrors> drawn;    // pixels covered by the model
  std::vector<DepthErrors> dense;    // gaps filled with the depth of the nearest covered pixel
  std::vector<DepthErrors> control;  // true depth of the previous frame
  int missing = 0;                   // held-out frames without a model, a pose or true depth
};

struct C3vdBenchmarkResult {
  PathBenchmarkResult path;
  std::vector<HeldOutDepths> depths;  // one per clip of `path`
};

/// Table of the path, and the depth errors: means per frame, per clip, over the clips.
FactSheet c3vdBenchmarkFacts(const C3vdBenchmarkResult& result);

}  // namespace softscope
