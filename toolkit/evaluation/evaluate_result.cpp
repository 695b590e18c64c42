// toolkit/evaluation/evaluate_result.cpp: calls of the functions of eval for a run.
#include "toolkit/evaluation/evaluate_result.h"

#include <algorithm>

#include "core/error.h"
#include "io/text/message.h"
#include "toolkit/run/table_reader.h"

namespace softscope {
namespace {

constexpr double kForeignMm = 20;  // a model at a larger distance belongs to another sequence

double valueOf(const std::map<int, double>& values, int frame) {
  const auto found = values.find(frame);
  return found == values.end() ? Statistics::kNone : found->second;
}

TrueTracks positionsOf(const std::vector<TrackSample>& samples) {
  TrueTracks positions_mm;
  for (const TrackSample& sample : samples)
    if (sample.position_mm.allFinite())
      positions_mm[{sample.frame, sample.id}] = sample.position_mm;
  return positions_mm;
}

}  // namespace

CameraResult judgeCamera(const JudgedRun& run, const SequenceTruth& truth) {
  const auto first = std::find_if(run.frames.begin(), run.frames.end(),
                                  [&](int frame) { return run.isPlaced(frame); });
  const bool begins_later = first != run.frames.end() && *first != 0;
  Eigen::Isometry3d start_from_world = Eigen::Isometry3d::Identity();
  CameraResult result;
  std::vector<Eigen::Isometry3d> true_poses, poses;
  std::vector<int> places;
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    const auto truth_there = truth.poses.find(run.frames[k]);
    if (!run.isPlaced(run.frames[k]) || truth_there == truth.poses.end()) continue;
    const Eigen::Isometry3d& world_from_left = truth_there->second.world_from_left;
    if (places.empty() && begins_later)
      start_from_world = run.trajectory[k].world_from_left * world_from_left.inverse();
    places.push_back(static_cast<int>(k));
    result.frames.push_back(run.frames[k]);
    true_poses.push_back(start_from_world * world_from_left);
    poses.push_back(run.trajectory[k].world_from_left);
  }
  if (!poses.empty()) result.errors = trajectoryErrors(true_poses, poses, places);
  return result;
}

std::vector<TrackSample> readTrueTracks(const SequenceTruth& truth) {
  return truth.tracks.empty() ? std::vector<TrackSample>() : readTracks(truth.tracks);
}

std::optional<TrackErrors> judgeTracks(const JudgedRun& run, const SequenceTruth& truth,
                                       const std::vector<TrackSample>& true_samples) {
  if (run.tracks.empty() || truth.tracks.empty()) return std::nullopt;
  TrueTracks true_tracks;  // of frames with a true pose: others are left out
  for (const auto& [key, position_mm] : positionsOf(true_samples))
    if (truth.poses.count(key.first) > 0) true_tracks[key] = position_mm;
  UnseenTracks unseen;
  for (const TrackSample& sample : true_samples)
    if (!sample.visible) unseen.insert({sample.frame, sample.id});
  std::vector<TrackSample> tracks = readTracks(run.tracks);
  tracks.erase(std::remove_if(tracks.begin(), tracks.end(),
                              [&](const TrackSample& sample) {
                                return !run.isPlaced(sample.frame) ||
                                       truth.poses.count(sample.frame) == 0;
                              }),
               tracks.end());
  std::map<int, Eigen::Isometry3d> moves;
  for (const auto& [frame, move] : truthFromRun(run, truth))
    if (run.isPlaced(frame)) moves[frame] = move;
  TrackErrors errors = trackErrors(true_tracks, tracks, moves, unseen);
  if (!tracks.empty() && errors.without_truth == tracks.size())
    throw InputError(
        say(shown(run.tracks), ": has no frame and id in common with ", shown(truth.tracks),
            "; tracks of other points? Give `track=` the track_points.csv of the sequence"));
  return errors;
}

RevisitResult judgeRevisits(const JudgedRun& run, const SequenceTruth& truth,
                            const EvaluationResult& result) {
  std::vector<Eigen::Isometry3d> poses;
  std::map<int, std::vector<double>> tracks_mm;
  if (result.tracks)
    for (const TrackError& e : result.tracks->each) tracks_mm[e.frame].push_back(e.errorMm());
  std::map<int, double> surface_mm;
  for (const JudgedModel& model : result.surface.models)
    surface_mm[model.frame] = model.errors.observed_mm.mean;
  std::vector<double> of_tracks, of_surface;
  for (const int frame : run.frames) {
    const auto pose = truth.poses.find(frame);
    if (pose == truth.poses.end()) continue;
    poses.push_back(pose->second.world_from_left);
    of_tracks.push_back(statistics(tracks_mm[frame]).mean);
    const auto model = surface_mm.find(frame);
    of_surface.push_back(model == surface_mm.end() ? Statistics::kNone : model->second);
  }
  return {revisits(poses, of_surface, {}), revisits(poses, of_tracks, {})};
}

std::vector<JudgedFrame> judgeClaims(const JudgedRun& run,
                                     const std::vector<TrackSample>& true_samples,
                                     const EvaluationResult& result) {
  std::map<int, double> surface_mm, jump_mm, pose_mm, pose_deg;
  for (const JudgedModel& model : result.surface.models)
    surface_mm[model.frame] = model.errors.observed_mm.mean;
  if (result.tracks) jump_mm = largestJumps(*result.tracks);
  if (result.camera && !true_samples.empty() && isRigid(positionsOf(true_samples)))
    for (std::size_t k = 0; k < result.camera->frames.size(); ++k) {
      pose_mm[result.camera->frames[k]] = result.camera->errors.unaligned.each_mm[k];
      pose_deg[result.camera->frames[k]] = result.camera->errors.unaligned.each_deg[k];
    }
  std::vector<JudgedFrame> judged;
  for (const int frame : run.frames)
    if (run.counts(frame))
      judged.push_back({frame, valueOf(run.confidence, frame), valueOf(surface_mm, frame),
                        valueOf(pose_mm, frame), valueOf(pose_deg, frame),
                        valueOf(jump_mm, frame)});
  return judged;
}

std::vector<std::string> sequenceWarnings(const JudgedRun& run, const SequenceTruth& truth,
                                          const EvaluationResult& result) {
  std::vector<std::string> warnings;
  const auto& models = result.surface.models;
  if (models.empty())
    warnings.push_back(
        "no model was evaluated: no frame has both models/NNNNNN.ply and a true mesh. Reconstruct "
        "with --save-every, or simulate with --truth mesh");
  else if (models.front().errors.distance_mm.median > kForeignMm)
    warnings.push_back(say("the first model is ", models.front().errors.distance_mm.median,
                           " mm from the truth in the median; a run of another sequence, or in "
                           "another unit?"));
  const auto elsewhere = std::count_if(run.frames.begin(), run.frames.end(), [&](int frame) {
    return run.counts(frame) && !run.isPlaced(frame);
  });
  if (elsewhere > 0)
    warnings.push_back(say(elsewhere,
                           " fused frames show places in maps of their own (frames.csv "
                           "of the run, column map): their poses and tracked points count as not "
                           "reported"));
  if (run.frames.size() < static_cast<std::size_t>(truth.frame_count))
    warnings.push_back(say("the run has ", run.frames.size(), " of the sequence's ",
                           truth.frame_count, " frames; only these are evaluated"));
  const auto unknown = std::count_if(run.frames.begin(), run.frames.end(),
                                     [&](int frame) { return truth.poses.count(frame) == 0; });
  if (unknown > 0)
    warnings.push_back(say(unknown, " frames of the run have no true pose: they are left out"));
  if (run.outcomes.empty())
    warnings.push_back(
        "frames.csv of the run has no status, so all frames count; reconstruct again");
  if (run.tracks.empty() && !truth.tracks.empty())
    warnings.push_back("the run has no tracks.csv; reconstruct with --track to evaluate tracks");
  if (result.tracks && result.tracks->without_truth > 0)
    warnings.push_back(say(result.tracks->without_truth, " tracked positions have no truth"));
  return warnings;
}

const char* toString(MeshAlignment alignment) {
  switch (alignment) {
    case MeshAlignment::kNone:
      return "none";
    case MeshAlignment::kRigid:
      return "rigid";
    case MeshAlignment::kIcp:
      return "icp";
  }
  return "none";
}

}  // namespace softscope
