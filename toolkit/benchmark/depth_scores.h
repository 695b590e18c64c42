// toolkit/benchmark/depth_scores.h: table of the stereo depth benchmarks (SCARED, SERV-CT).
#pragma once

#include <string>
#include <vector>

#include "core/rectified_rig.h"
#include "eval/images/depth_errors.h"
#include "eval/images/disparity_errors.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// Errors of one pair: measured pixels, all pixels after filling, control.
struct DepthPairResult {
  std::string name;
  std::string group;       // data set of SCARED, experiment of SERV-CT
  std::string excluded;    // reason; empty for a pair that counts
  double known_share = 0;  // share of pixels with truth
  DepthErrors measured;
  DisparityErrors measured_px;
  DepthErrors dense;    // holes filled with the depth of the nearest measured pixel
  DepthErrors visible;  // measured pixels visible to both cameras
  DepthErrors hidden;   // dense; pixels visible to the left camera only
  DepthErrors control;  // every pixel at the median true depth
  double latency_ms = Statistics::kNone;
};

struct DepthBenchmarkResult {
  std::string title;     // "SCARED"
  std::string protocol;  // properties of the data set
  std::vector<DepthPairResult> pairs;
  std::vector<std::string> warnings;
  bool stopped = false;
};

/// Pairs with a smaller share of pixels with truth are excluded (protocol of SCARED).
inline constexpr double kLeastKnownShare = 0.1;

/// Computes all errors of a pair; excludes it if too few pixels have truth.
void judgeDepthPair(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                    const RectifiedRig& rig, DepthPairResult* result);

/// Means over pairs, then over groups; with protocol, exclusions, coverage, intervals, latency.
FactSheet depthBenchmarkFacts(const DepthBenchmarkResult& result);

}  // namespace softscope
