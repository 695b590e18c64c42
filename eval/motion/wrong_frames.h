// eval/motion/wrong_frames.h: detection of wrong frames that a run accepted.
#pragma once

#include <map>
#include <vector>

#include "eval/motion/track_errors.h"

namespace softscope {

/// Confidence of a fused frame with
/// its true errors; NaN if unknown.
struct JudgedFrame {
  int frame = 0;
  double confidence = Statistics::kNone;  // 0 to 1, reported by the run
  double surface_mm = Statistics::kNone;  // mean error of the observed surface
  double pose_mm = Statistics::kNone;     // of the camera, in a rigid scene
  double pose_deg = Statistics::kNone;
  double jump_mm = Statistics::kNone;  // largest of largestJumps
};

/// Mean error of the observed surface above 1 mm; in a rigid scene a pose error
/// above 1 mm or 1 deg; a visible point whose error jumps by more than 1 mm.
bool isWrong(const JudgedFrame& judged);

/// Wrong frame with a confidence above one half.
bool isSilentlyWrong(const JudgedFrame& judged);

/// By frame, from the second on: maximum change of the error vector of a point since the
/// previous evaluated frame. Counts points visible in both frames according to run and truth.
std::map<int, double> largestJumps(const TrackErrors& tracks);

/// True if no tissue point moves. True without points.
bool isRigid(const TrueTracks& truth);

}  // namespace softscope
