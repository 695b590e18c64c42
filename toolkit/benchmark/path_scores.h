// toolkit/benchmark/path_scores.h: the table of benchmarks of the scope's path (StereoMIS).
#pragma once

#include <string>
#include <vector>

#include "eval/motion/trajectory_errors.h"
#include "toolkit/benchmark/benchmark_runs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

/// One range of one sequence.
struct PathClipResult {
  std::string name;                 // P2_3_000100
  std::string sequence;             // P2_3
  std::string excluded;             // why; empty where it counts
  TrajectoryErrors found, control;  // the control stays at one place
  int frames = 0;                   // with a true pose
  int lost = 0;                     // of these, whose pose the run holds for wrong: not judged
  std::vector<double> latency_ms;
};

struct PathBenchmarkResult {
  std::string title;
  std::vector<PathClipResult> clips;
  bool stopped = false;
};

/// ATE and RPE, SE(3) and Sim(3), means over ranges; with control, protocol, exclusions, coverage,
/// intervals, latency.
FactSheet pathBenchmarkFacts(const PathBenchmarkResult& result);

}  // namespace softscope
