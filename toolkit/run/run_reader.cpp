// toolkit/run/run_reader.cpp: search of files and consistency checks.
#include "toolkit/run/run_reader.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "core/error.h"
#include "io/files/file_bytes.h"
#include "io/files/folder.h"
#include "io/geometry/trajectory_file.h"
#include "io/sequences/timestamps_file.h"
#include "io/text/message.h"
#include "stereo/rectification/rectifier.h"
#include "toolkit/run/frame_clock.h"
#include "toolkit/run/sequence_calibration.h"
#include "toolkit/run/table_reader.h"

namespace softscope {
namespace {

namespace fs = std::filesystem;

fs::path fileOrNone(const fs::path& file) { return isThere(file) ? file : fs::path(); }

Trajectory readRunTrajectory(const fs::path& folder) {
  requireFolder(folder);
  const fs::path file = folder / "trajectory.txt";
  if (!isThere(file))
    throw InputError(shown(file) +
                     ": is missing, but every run has one; give the folder that softscope "
                     "reconstruct wrote");
  return readTrajectory(file);
}

FrameRows frameRows(const fs::path& file, std::size_t poses) {
  FrameRows rows;
  rows.frames.resize(poses);
  std::iota(rows.frames.begin(), rows.frames.end(), 0);
  if (!isThere(file)) return rows;
  rows = readFrameRows(file);
  if (rows.frames.size() != poses)
    throw InputError(say(shown(file), ": has ", rows.frames.size(),
                         " frames, but trajectory.txt has ", poses,
                         " poses; a run that was cut short? Reconstruct again"));
  return rows;
}

/// The frame at a time; -1 if there is none.
int frameAt(double time_s, const std::vector<double>& times_s) {
  constexpr double kSameTimeS = 1e-3;
  const auto next = std::lower_bound(times_s.begin(), times_s.end(), time_s - kSameTimeS);
  return next != times_s.end() && *next <= time_s + kSameTimeS
             ? static_cast<int>(next - times_s.begin())
             : -1;
}

/// `times_s`: of the frames; empty if unknown.
std::map<int, TimedPose> posesByFrame(const fs::path& file, const std::vector<double>& times_s) {
  const Trajectory trajectory = readTrajectory(file);
  const bool by_line = times_s.empty() || times_s.size() == trajectory.size();
  std::map<int, TimedPose> poses;
  for (const TimedPose& pose : trajectory) {
    const int frame = by_line ? static_cast<int>(poses.size()) : frameAt(pose.time_s, times_s);
    if (frame < 0)
      throw InputError(say(shown(file), ": has a pose at ", pose.time_s, " s, but no frame in ",
                           "timestamps.txt has this time, and there are ", trajectory.size(),
                           " poses of ", times_s.size(),
                           " frames; give each pose the time of its frame"));
    poses.insert({frame, pose});
  }
  return poses;
}

bool haveClock(const std::map<int, TimedPose>& poses) {
  std::vector<int> frames;
  std::vector<double> times_s;
  for (const auto& [frame, pose] : poses) {
    frames.push_back(frame);
    times_s.push_back(pose.time_s);
  }
  return hasClock(frames, times_s);
}

/// The model of the first frame is the depth of that frame.
bool measuresBackProjection(const FrameRows& rows, std::size_t k) {
  return rows.statuses.empty() || (outcomeOf(rows.statuses[k]) == FusionOutcome::kFused &&
                                   rows.statuses[k] != FrameStatus::kStarted);
}

}  // namespace

FrameFiles numberedFiles(const fs::path& folder, std::string_view extension) {
  FrameFiles files;
  if (!isThere(folder)) return files;
  for (const fs::path& file : filesIn(folder, {extension})) {
    const std::string stem = file.stem().string();
    if (stem.size() >= 6 && stem.size() <= 9 &&
        stem.find_first_not_of("0123456789") == std::string::npos)
      files[std::stoi(stem)] = file;
  }
  return files;
}

std::vector<std::string> JudgedRun::warnings() const {
  if (!stopped) return {};
  return {say("the run was stopped or killed, or is in progress: its last frame is ", frames.back(),
              ", and later frames are not in these numbers; continue with reconstruct --resume")};
}

double JudgedRun::timeOf(int frame) const {
  const auto found = std::lower_bound(frames.begin(), frames.end(), frame);
  if (found == frames.end() || *found != frame) return std::nan("");
  if (!hasClock(frames, trajectory)) return std::nan("");
  return trajectory[static_cast<std::size_t>(found - frames.begin())].time_s;
}

bool JudgedRun::isInFirstMap(int frame) const {
  const auto map = maps.find(frame);
  return map == maps.end() || map->second == 0;
}

FrameFiles JudgedRun::countedModels() const {
  FrameFiles counted;
  for (const auto& [frame, file] : models)
    if (counts(frame)) counted[frame] = file;
  return counted;
}

int JudgedRun::lastCounted() const {
  const auto last = std::find_if(frames.rbegin(), frames.rend(), [&](int f) { return counts(f); });
  return last == frames.rend() ? frames.back() : *last;
}

double SequenceTruth::timeOf(int frame) const {
  const auto pose = poses.find(frame);
  return has_clock && pose != poses.end() ? pose->second.time_s : std::nan("");
}

int holdOutEvery(const fs::path& run_folder) {
  const fs::path file = run_folder / "run.json";
  if (!isFile(file)) return 0;
  const auto json = nlohmann::json::parse(readBytes(file, kTextLimitBytes), nullptr,
                                          /*allow_exceptions=*/false);
  if (!json.is_object() || !json.contains(kHoldOutKey)) return 0;
  const auto& every = json[kHoldOutKey];
  return every.is_number_integer() && every >= 2 && every <= 1000000 ? every.get<int>() : 0;
}

JudgedRun openJudgedRun(const fs::path& folder) {
  JudgedRun run;
  run.folder = folder;
  run.trajectory = readRunTrajectory(folder);
  const FrameRows rows = frameRows(folder / "frames.csv", run.trajectory.size());
  run.frames = rows.frames;
  for (std::size_t k = 0; k < rows.statuses.size(); ++k)
    run.outcomes.set(rows.frames[k], outcomeOf(rows.statuses[k]));
  for (std::size_t k = 0; k < rows.maps.size(); ++k) run.maps[rows.frames[k]] = rows.maps[k];
  for (std::size_t k = 0; k < rows.backprojection_mm.size(); ++k)
    if (std::isfinite(rows.backprojection_mm[k]) && measuresBackProjection(rows, k))
      run.backprojection_mm[rows.frames[k]] = rows.backprojection_mm[k];
  for (std::size_t k = 0; k < rows.coverage.size(); ++k)
    if (std::isfinite(rows.coverage[k])) run.coverage[rows.frames[k]] = rows.coverage[k];
  for (std::size_t k = 0; k < rows.confidence.size(); ++k)
    if (std::isfinite(rows.confidence[k])) run.confidence[rows.frames[k]] = rows.confidence[k];
  run.stopped = isThere(folder / "checkpoint.bin") || isThere(folder / "writing.lock");
  run.hold_out_every = holdOutEvery(folder);
  run.models = numberedFiles(folder / "models", ".ply");
  run.last_model = fileOrNone(folder / "model.ply");
  run.tracks = fileOrNone(folder / "tracks.csv");
  return run;
}

bool hasTruth(const fs::path& sequence) { return isThere(sequence / "groundtruth"); }

SequenceTruth openSequenceTruth(const fs::path& sequence) {
  requireFolder(sequence);
  const fs::path truth_folder = sequence / "groundtruth";
  if (!isThere(truth_folder / "trajectory.txt"))
    throw InputError(shown(truth_folder / "trajectory.txt") +
                     ": is missing, but the true camera poses are required; give a sequence with "
                     "ground truth, or a mesh");
  SequenceTruth truth;
  truth.folder = sequence;
  std::vector<double> times_s;
  if (isThere(sequence / "timestamps.txt")) times_s = readTimestamps(sequence / "timestamps.txt");
  truth.poses = posesByFrame(truth_folder / "trajectory.txt", times_s);
  truth.has_clock = haveClock(truth.poses);
  truth.frame_count =
      times_s.empty() ? static_cast<int>(truth.poses.size()) : static_cast<int>(times_s.size());
  truth.meshes = numberedFiles(truth_folder / "mesh", ".ply");
  truth.depths = numberedFiles(truth_folder / "depth", ".png");
  truth.tracks = fileOrNone(truth_folder / "tracks.csv");
  const StereoCalibration calibration = sequenceCalibration(sequence);
  truth.rig = Rectifier(calibration).rig();
  truth.rectified = calibration.rectified;
  truth.depth_unit_mm = calibration.depth_unit_mm;
  return truth;
}

void requireSameSequence(const JudgedRun& run, const SequenceTruth& truth) {
  const int count = truth.frame_count;
  const auto fail = [&](const fs::path& file, int frame) {
    throw InputError(say(shown(file), ": is of frame ", frame, ", but ", shown(truth.folder),
                         " has the frames 0 to ", count - 1, "; a run of another sequence?"));
  };
  if (run.frames.back() >= count) fail(run.folder / "trajectory.txt", run.frames.back());
  for (const auto& [frame, file] : run.models)
    if (!std::binary_search(run.frames.begin(), run.frames.end(), frame)) {
      if (frame >= count) fail(file, frame);
      throw InputError(say(shown(file), ": is of frame ", frame,
                           ", but trajectory.txt has no pose of it; reconstruct again"));
    }
}

std::map<int, Eigen::Isometry3d> truthFromRun(const JudgedRun& run, const SequenceTruth& truth) {
  std::map<int, Eigen::Isometry3d> moves;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const auto pose = truth.poses.find(run.frames[k]);
    if (pose != truth.poses.end())
      moves[run.frames[k]] =
          pose->second.world_from_left * run.trajectory[k].world_from_left.inverse();
  }
  return moves;
}

}  // namespace softscope
