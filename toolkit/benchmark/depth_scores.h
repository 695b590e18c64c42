// toolkit/benchmark/depth_scores.h: the table of stereo depth benchmarks (SCARED, SERV-CT).
#pragma once

#include <string>
#include <vector>

#include "core/rectified_rig.h"
#include "eval/images/depth_errors.h"
#include "eval/images/disparity_errors.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// One pair: what was measured, every pixel filled, and the control.
struct DepthPairResult {
  std::string name;
  std::string group;       // data set of SCARED, experiment of SERV-CT
  std::string excluded;    // why; empty where it counts
  double known_share = 0;  // of the pixels
  DepthErrors measured;
  DisparityErrors measured_px;
  DepthErrors dense;    // holes take the nearest measured pixel's depth
  DepthErrors visible;  // measured pixels that both cameras see
  DepthErrors hidden;   // dense, pixels that the left camera alone sees
  DepthErrors control;  // every pixel at the median true depth
  double latency_ms = Statistics::kNone;
};

struct DepthBenchmarkResult {
  std::string title;     // "SCARED"
  std::string protocol;  // what is particular to the data set
  std::vector<DepthPairResult> pairs;
  std::vector<std::string> warnings;
  bool stopped = false;
};

/// Below this share of pixels with truth a pair is left out, as by SCARED's protocol.
inline constexpr double kLeastKnownShare = 0.1;

/// Fills all errors of a pair; excludes it where too little truth is known.
void judgeDepthPair(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                    const RectifiedRig& rig, DepthPairResult* result);

/// Means over pairs, then over groups; with protocol, exclusions, coverage, intervals, latency.
FactSheet depthBenchmarkFacts(const DepthBenchmarkResult& result);

}  // namespace softscope
