// toolkit/run/run_reader.h: reader of a run and of its ground truth.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/stereo_rig.h"
#include "core/trajectory.h"
#include "toolkit/run/frame_outcomes.h"

namespace softscope {

using FrameFiles = std::map<int, std::filesystem::path>;

/// NNNNNN.ext by number; names of other forms are left out. Empty where the folder is missing.
FrameFiles numberedFiles(const std::filesystem::path& folder, std::string_view extension);

/// A folder that `reconstruct` wrote (docs/formats.md).
struct JudgedRun {
  std::filesystem::path folder;
  Trajectory trajectory;                    // world_from_left
  std::vector<int> frames;                  // the frame of each pose, rising
  FrameOutcomes outcomes;                   // of frames.csv
  std::map<int, double> backprojection_mm;  // of frames that were fused into the model, not the
                                            // first one, whose value is zero by construction
  std::map<int, double> coverage;           // share of the tissue that has depth, of all frames
  std::map<int, double> confidence;         // of pose and warp, as the run says
  FrameFiles models;                        // models/NNNNNN.ply
  int hold_out_every = 0;                   // frames 1, n + 1, … were held out; 0: none
  bool stopped = false;                     // before its end: the clip's last frames lack
  std::filesystem::path last_model;         // model.ply; empty where it is missing
  std::filesystem::path tracks;             // tracks.csv; empty where it is missing

  /// Warning for readers of its numbers; empty for a run that reached its end.
  std::vector<std::string> warnings() const;
  /// NaN where the frame has no pose, and for all frames of a clip without timestamps.
  double timeOf(int frame) const;
  /// Whether the frame's pose, model and tracks say something of it: it was fused.
  bool counts(int frame) const { return outcomes.fused(frame); }
  /// Of the models, those that count.
  FrameFiles countedModels() const;
  /// The frame that the last model shows: the last that counts.
  int lastCounted() const;
};

/// Of run.json, what JudgedRun has; 0 where it doesn't say.
inline constexpr const char* kHoldOutKey = "hold_out_every";
int holdOutEvery(const std::filesystem::path& run_folder);

/// Throws InputError: no such folder, no trajectory, or a table of frames that doesn't fit it.
JudgedRun openJudgedRun(const std::filesystem::path& folder);

/// Whether there is a folder groundtruth in it, whatever that holds.
bool hasTruth(const std::filesystem::path& sequence);

/// The ground truth of a sequence folder.
struct SequenceTruth {
  std::filesystem::path folder;  // of the sequence
  Trajectory trajectory;         // world_from_left; pose i is that of frame i
  FrameFiles meshes, depths;     // groundtruth/mesh, groundtruth/depth
  std::filesystem::path tracks;  // groundtruth/tracks.csv; empty where it is missing
  RectifiedRig rig;
  double depth_unit_mm = 0.01;
  bool rectified = true;  // so are the images, and what is given for their pixels

  /// NaN where the clip has no timestamps.
  double timeOf(int frame) const;
};

/// Throws InputError: no such folder, no groundtruth in it, no true trajectory, no calibration.
SequenceTruth openSequenceTruth(const std::filesystem::path& sequence);

/// Throws InputError where the run can't be one of this sequence: more frames, or models of frames
/// that the sequence lacks.
void requireSameSequence(const JudgedRun& run, const SequenceTruth& truth);

/// For every pose of the run that has a true one, what brings a point of the run's world into the
/// true world by way of that moment's camera: a motion of the whole scene can be tissue or scope,
/// so both are compared as the camera sees them.
std::map<int, Eigen::Isometry3d> truthFromRun(const JudgedRun& run, const SequenceTruth& truth);

}  // namespace softscope
