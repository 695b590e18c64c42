// toolkit/evaluation/run_moment.h: one model of a run beside the truth of its moment, for figures.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/surfaces/model_errors.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// All in the left camera's frame of that moment: a motion of the whole scene can be tissue or
/// scope, so both are compared as the camera sees them.
struct RunMoment {
  int frame = 0;
  double time_s = 0;
  TriangleMesh truth;
  TriangleMesh model;  // with its colours; points, or on demand a surface
  TriangleMesh scan;   // the tissue that the scope sees, from the true depth
  ModelErrors errors;
  Eigen::Isometry3d left_from_true_world = Eigen::Isometry3d::Identity();
  std::filesystem::path truth_file, model_file, scan_file;

  /// Of all points, or with NaN for those that the scope doesn't see now.
  std::vector<double> distances(bool observed_only) const;
  std::vector<double> signedDistances(bool observed_only) const;
};

/// "frame 20, 0.80 s"; `time_s` is NaN where the clip has no timestamps.
std::string momentText(int frame, double time_s);

/// A run and the sequence that it was made from.
struct JudgedPair {
  JudgedRun run;
  SequenceTruth truth;
  std::vector<std::string> warnings;

  /// Throws InputError where either can't be used, or they don't belong together, or no frame has
  /// both a model and a true mesh.
  JudgedPair(const std::string& run_folder, const std::string& sequence);

  std::vector<int> frames() const;
  /// `wanted`, or the last one where that is -1. Throws OptionError for a frame that isn't there.
  int chooseFrame(int wanted) const;
  /// `surface`: with triangles between the model's points.
  RunMoment moment(int frame, bool surface) const;
};

}  // namespace softscope
