// eval/motion/box_tracking.h: SurgT's scores of a tracker of stereo bounding boxes.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/rectified_rig.h"
#include "eval/statistics/statistics.h"

namespace softscope {

/// In rectified pixels; (u, v) is the upper left corner.
struct PixelBox {
  double u_px = 0, v_px = 0, width_px = 0, height_px = 0;
};

struct StereoBoxes {
  PixelBox left, right;
};

/// One frame's truth.
struct BoxTruth {
  bool visible = false;    // in both views
  bool difficult = false;  // ignored by every score but the excess frames
  std::optional<StereoBoxes> boxes;
};

struct BoxTrackingOptions {
  int misses_allowed = 10;      // one more in succession is a failure
  double overlap_limit = 0.1;   // a miss in 2-D: intersection over union of either view not above
  double error_limit_mm = 100;  // a miss in 3-D: an error above
  int first_rank = 150;         // EAO: mean of the curve's values [first_rank, last_rank)
  int last_rank = 829;

  /// Throws OptionError.
  void validate() const;
};

/// A tracker that was started in a frame with the true boxes.
struct BoxTrack {
  int first_frame = 0;
  /// Of frames first_frame + 1, + 2, …; empty where it gave none. What lies beyond the truth's last
  /// frame is ignored, missing frames at the end count as given none.
  std::vector<std::optional<StereoBoxes>> boxes;
};

/// Of one track, or of many. NaN where the weight is 0.
struct BoxScores {
  double accuracy = Statistics::kNone;       // mean overlap before the failure
  double robustness_2d = Statistics::kNone;  // hits / (visible frames + excess frames)
  double robustness_3d = Statistics::kNone;
  double error_px = Statistics::kNone;  // of the boxes' centres, mean of both views
  double error_sd_px = Statistics::kNone;
  double error_mm = Statistics::kNone;
  double error_sd_mm = Statistics::kNone;
  std::size_t frames_2d = 0;      // weight of accuracy and error_px
  std::size_t frames_judged = 0;  // weight of both robustnesses
  std::size_t frames_3d = 0;      // weight of error_mm
};

struct JudgedBoxTrack {
  BoxScores scores;
  std::vector<double> overlaps;  // one a frame to the last judgeable one; NaN = ignored
};

/// The scores of SurgT (Cartucho et al., 2024), in all that decides a number as its script
/// computes them: docs/evaluation.md. Throws InputError where first_frame has no usable truth.
JudgedBoxTrack judgeBoxTrack(const std::vector<BoxTruth>& truth, const BoxTrack& track,
                             const RectifiedRig& rig, const BoxTrackingOptions& options = {});

/// Means weighted by the frames, sums of the frames.
BoxScores mergeBoxScores(const std::vector<BoxScores>& scores);

/// Mean of sequences of overlaps, rank by rank, without the ignored; NaN where all are.
std::vector<double> overlapCurve(const std::vector<std::vector<double>>& sequences);

/// EAO of the curves of all target boxes (one a target: overlapCurve of its tracks).
double expectedAverageOverlap(const std::vector<std::vector<double>>& target_curves,
                              const BoxTrackingOptions& options = {});

/// Intersection over union, 0 to 1.
double boxOverlap(const PixelBox& a, const PixelBox& b);

}  // namespace softscope
