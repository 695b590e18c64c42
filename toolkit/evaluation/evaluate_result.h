// toolkit/evaluation/evaluate_result.h: results of one evaluation.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "eval/motion/revisit.h"
#include "eval/motion/track_errors.h"
#include "eval/motion/trajectory_errors.h"
#include "eval/motion/wrong_frames.h"
#include "toolkit/evaluation/evaluate_series.h"
#include "toolkit/evaluation/held_out_views.h"

namespace softscope {

/// Camera path against the true path; values in the order of `frames`.
struct CameraResult {
  std::vector<int> frames;
  TrajectoryErrors errors;
};

/// Errors at revisits of an earlier camera pose: of the visible surface and of tracks.
struct RevisitResult {
  Revisits surface, tracks;
};

struct EvaluationResult {
  std::string run, reference;  // paths as given
  bool against_mesh = false;   // else against the ground truth of a sequence
  MeshAlignment alignment = MeshAlignment::kNone;
  std::vector<SurfaceAlignment> alignments;
  SurfaceSeries surface;
  std::optional<CameraResult> camera;
  std::optional<TrackErrors> tracks;
  RevisitResult revisits;
  std::vector<JudgedFrame> judged_frames;  // fused frames
  HeldOutResult held_out;
  FrameOutcomes outcomes;                   // of the run
  std::map<int, double> times_s;            // of all frames of the run; NaN without timestamps
  std::map<int, double> backprojection_mm;  // by frame, as reported by the run
  std::vector<std::string> warnings;
};

/// Over the fused frames. For a run that begins after frame 0, true
/// poses are relative to its first fused frame, the origin of its world.
CameraResult judgeCamera(const JudgedRun& run, const SequenceTruth& truth);

/// Empty for a sequence without tracks.csv.
std::vector<TrackSample> readTrueTracks(const SequenceTruth& truth);

/// Throws InputError if the tracks of the run and the true
/// tracks have no common point. None without both tracks.csv.
std::optional<TrackErrors> judgeTracks(const JudgedRun& run, const SequenceTruth& truth,
                                       const std::vector<TrackSample>& true_samples);

/// Requires surface and tracks in the result.
RevisitResult judgeRevisits(const JudgedRun& run, const SequenceTruth& truth,
                            const EvaluationResult& result);

/// Requires surface, camera and tracks in the result. Confidence
/// reported by the run for each fused frame, with its true errors.
std::vector<JudgedFrame> judgeClaims(const JudgedRun& run,
                                     const std::vector<TrackSample>& true_samples,
                                     const EvaluationResult& result);

/// Warnings about a result: frames without a model, missing parts, an
/// implausibly distant model. They do not invalidate the other values.
std::vector<std::string> sequenceWarnings(const JudgedRun& run, const SequenceTruth& truth,
                                          const EvaluationResult& result);

const char* toString(MeshAlignment alignment);

}  // namespace softscope
