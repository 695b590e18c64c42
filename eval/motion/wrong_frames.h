// eval/motion/wrong_frames.h: frames that a run accepts although they are wrong.
#pragma once

#include <map>
#include <vector>

#include "eval/motion/track_errors.h"

namespace softscope {

/// What a run claims of a fused frame, and how far that is from the truth; NaN where either is not
/// known.
struct JudgedFrame {
  int frame = 0;
  double confidence = Statistics::kNone;  // 0 to 1, by the run
  double surface_mm = Statistics::kNone;  // mean error of the observed surface
  double pose_mm = Statistics::kNone;     // of the scope, where the scene is rigid
  double pose_deg = Statistics::kNone;
  double jump_mm = Statistics::kNone;  // largest of largestJumps
};

/// An observed surface more than 1 mm off in the mean; over rigid tissue a pose more than 1 mm or
/// 1 deg off; a point in view that jumps by more than 1 mm against its truth.
bool isWrong(const JudgedFrame& judged);

/// A wrong frame that is not reported as such: its confidence is above one half.
bool isSilentlyWrong(const JudgedFrame& judged);

/// By frame, from the second on: by how much the error of a point, as a vector, changes at most
/// from the judged frame before. Points count that the run and the truth see in both frames.
std::map<int, double> largestJumps(const TrackErrors& tracks);

/// Whether no point of the tissue ever moves. True without points.
bool isRigid(const TrueTracks& truth);

}  // namespace softscope
