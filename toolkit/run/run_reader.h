// toolkit/run/run_reader.h: reader of a run and its ground truth.
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

/// Files NNNNNN.ext by number; others are ignored. Empty for a missing folder.
FrameFiles numberedFiles(const std::filesystem::path& folder, std::string_view extension);

/// Folder written by `reconstruct` (docs/formats.md).
struct JudgedRun {
  std::filesystem::path folder;
  Trajectory trajectory;                    // world_from_left
  std::vector<int> frames;                  // frame of each pose, ascending
  FrameOutcomes outcomes;                   // of frames.csv
  std::map<int, double> backprojection_mm;  // of fused frames, without the first one,
                                            // whose value is zero by construction
  std::map<int, double> coverage;           // share of tissue with depth, of all frames
  std::map<int, double> confidence;         // of pose and warp, as reported by the run
  std::map<int, int> maps;                  // in whose world the pose of a frame is
  FrameFiles models;                        // models/NNNNNN.ply
  int hold_out_every = 0;                   // frames 1, n + 1, … are held out; 0: none
  bool stopped = false;                     // before the end of the clip
  std::filesystem::path last_model;         // model.ply; empty if missing
  std::filesystem::path tracks;             // tracks.csv; empty if missing

  /// Warning about an unfinished run; else empty.
  std::vector<std::string> warnings() const;
  /// NaN for a frame without a pose, and for clips without timestamps.
  double timeOf(int frame) const;
  /// True if the model describes the frame: it was fused.
  bool counts(int frame) const { return outcomes.fused(frame); }
  /// True if pose and tracks describe it as well: it was fused with the first model. The pose
  /// relative to the first one is unknown in a frame of another.
  bool isPlaced(int frame) const { return counts(frame) && isInFirstMap(frame); }
  bool isInFirstMap(int frame) const;
  /// Models of fused frames.
  FrameFiles countedModels() const;
  /// Frame of the last model: the last fused frame.
  int lastCounted() const;
};

/// Key in run.json of the member of JudgedRun; 0 if absent.
inline constexpr const char* kHoldOutKey = "hold_out_every";
int holdOutEvery(const std::filesystem::path& run_folder);

/// Throws InputError: no such folder, no trajectory, or an inconsistent table of frames.
JudgedRun openJudgedRun(const std::filesystem::path& folder);

/// True if the folder contains a folder groundtruth.
bool hasTruth(const std::filesystem::path& sequence);

/// Ground truth of a sequence folder.
struct SequenceTruth {
  std::filesystem::path folder;    // sequence folder
  std::map<int, TimedPose> poses;  // of those frames that have one
  int frame_count = 0;             // of the sequence
  bool has_clock = false;          // the poses have times
  FrameFiles meshes, depths;       // groundtruth/mesh, groundtruth/depth
  std::filesystem::path tracks;    // groundtruth/tracks.csv; empty if missing
  RectifiedRig rig;
  double depth_unit_mm = 0.01;
  bool rectified = true;  // whether images and pixel coordinates are rectified

  /// NaN for a clip without timestamps.
  double timeOf(int frame) const;
};

/// A pose belongs to the frame of its time; to that of its line where the sequence has no times, or
/// as many as the trajectory has poses. Throws InputError: no such folder, no groundtruth in it, no
/// true trajectory, no calibration, or a pose at a time of no frame.
SequenceTruth openSequenceTruth(const std::filesystem::path& sequence);

/// Throws InputError if the run cannot belong to this
/// sequence: more frames, or models of other frames.
void requireSameSequence(const JudgedRun& run, const SequenceTruth& truth);

/// For every pose of the run with a true pose: transform from the world of the run
/// into the true world through the camera of that frame. A motion of the whole
/// scene can be due to tissue or scope, so both are compared in camera coordinates.
std::map<int, Eigen::Isometry3d> truthFromRun(const JudgedRun& run, const SequenceTruth& truth);

}  // namespace softscope
