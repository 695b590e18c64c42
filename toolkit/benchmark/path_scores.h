// toolkit/benchmark/path_scores.h: scores and table of the trajectory benchmarks.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <string>
#include <vector>

#include "eval/motion/trajectory_errors.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// Scores of one range of a sequence.
struct PathClipResult {
  std::string name;                 // P2_3_000100
  std::string sequence;             // P2_3
  std::string excluded;             // reason; empty for a range that counts
  TrajectoryErrors found, control;  // control: constant pose
  int frames = 0;                   // with a true pose
  int lost = 0;                     // frames that the run reports as lost: excluded
  std::vector<double> latency_ms;
};

struct PathBenchmarkResult {
  std::string title;
  std::string protocol;  // ranges and poses of the data set
  std::vector<PathClipResult> clips;
  bool stopped = false;
};

/// Compares the poses of a run with true ones of the raw left camera, by frame. Throws InputError
/// for fewer than two frames with both.
void judgePath(const JudgedRun& run, const std::map<int, Eigen::Isometry3d>& world_from_raw_left,
               const Eigen::Isometry3d& rectified_from_raw, PathClipResult* result);

/// ATE and RPE, SE(3) and Sim(3), means over ranges; with control, protocol, exclusions, coverage,
/// intervals, latency.
FactSheet pathBenchmarkFacts(const PathBenchmarkResult& result);

}  // namespace softscope
