// toolkit/evaluation/run_moment.h: one model of a run with the truth of its frame, for figures.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"
#include "eval/surfaces/model_errors.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/run/run_reader.h"

namespace softscope {

/// All in the left camera frame of that time: a motion of the whole scene can
/// be due to tissue or scope, so both are compared in camera coordinates.
struct RunMoment {
  int frame = 0;
  double time_s = 0;
  TriangleMesh truth;
  TriangleMesh model;  // with its colours; points, or a surface on request
  TriangleMesh scan;   // visible tissue, from the true depth
  ModelErrors errors;
  Eigen::Isometry3d left_from_true_world = Eigen::Isometry3d::Identity();
  std::filesystem::path truth_file, model_file, scan_file;

  /// Of all points, or with NaN for points that the scope does not see now.
  std::vector<double> distances(bool observed_only) const;
  std::vector<double> signedDistances(bool observed_only) const;
};

/// "frame 20, 0.80 s"; `time_s` is NaN for a clip without timestamps.
std::string momentText(int frame, double time_s);

/// Run with its sequence.
struct JudgedPair {
  JudgedRun run;
  SequenceTruth truth;
  std::vector<std::string> warnings;

  /// Throws InputError for unusable folders, folders that do not
  /// belong together, or no frame with both a model and a true mesh.
  JudgedPair(const std::string& run_folder, const std::string& sequence);

  std::vector<int> frames() const;
  /// `wanted`, or the last frame for -1. Throws OptionError for a missing frame.
  int chooseFrame(int wanted) const;
  /// `surface`: with triangles between the points of the model.
  RunMoment moment(int frame, bool surface) const;
};

}  // namespace softscope
