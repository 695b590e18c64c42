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

/// The scope's path against the true one; values are in the order of `frames`.
struct CameraResult {
  std::vector<int> frames;
  TrajectoryErrors errors;
};

/// Errors when the scope is back where it was: of what it sees, and of tracks.
struct RevisitResult {
  Revisits surface, tracks;
};

struct EvaluationResult {
  std::string run, reference;  // as the user named them
  bool against_mesh = false;   // else against a sequence's ground truth
  MeshAlignment alignment = MeshAlignment::kNone;
  std::vector<SurfaceAlignment> alignments;
  SurfaceSeries surface;
  std::optional<CameraResult> camera;
  std::optional<TrackErrors> tracks;
  RevisitResult revisits;
  std::vector<JudgedFrame> judged_frames;  // those that were fused
  HeldOutResult held_out;
  FrameOutcomes outcomes;                   // of the run
  std::map<int, double> times_s;            // of all frames of the run; NaN without timestamps
  std::map<int, double> backprojection_mm;  // by frame, as the run itself measured it
  std::vector<std::string> warnings;
};

/// Of the frames that were fused. Poses of a run that doesn't begin at frame 0 are taken from its
/// first frame on, as its own world begins there.
CameraResult judgeCamera(const JudgedRun& run, const SequenceTruth& truth);

/// Empty where the sequence has no tracks.csv.
std::vector<TrackSample> readTrueTracks(const SequenceTruth& truth);

/// Throws InputError where the run's tracks have nothing in common with the true ones. None where
/// either lacks tracks.csv.
std::optional<TrackErrors> judgeTracks(const JudgedRun& run, const SequenceTruth& truth,
                                       const std::vector<TrackSample>& true_samples);

/// Of a result that holds surface and tracks already.
RevisitResult judgeRevisits(const JudgedRun& run, const SequenceTruth& truth,
                            const EvaluationResult& result);

/// Of a result that holds surface, camera and tracks already: what the run claims of each fused
/// frame.
std::vector<JudgedFrame> judgeClaims(const JudgedRun& run,
                                     const std::vector<TrackSample>& true_samples,
                                     const EvaluationResult& result);

/// Warnings for the reader of a result: frames without a model, parts that lack, a model that
/// is suspiciously far away. Nothing of it keeps the rest from being right.
std::vector<std::string> sequenceWarnings(const JudgedRun& run, const SequenceTruth& truth,
                                          const EvaluationResult& result);

const char* toString(MeshAlignment alignment);

}  // namespace softscope
