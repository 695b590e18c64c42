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

/// Truth of one frame.
struct BoxTruth {
  bool visible = false;    // in both views
  bool difficult = false;  // excluded from all scores except the excess frames
  std::optional<StereoBoxes> boxes;
};

struct BoxTrackingOptions {
  int misses_allowed = 10;      // one more consecutive miss is a failure
  double overlap_limit = 0.1;   // 2-D miss: intersection over union of a view not above
  double error_limit_mm = 100;  // 3-D miss: error above this limit
  int first_rank = 150;         // EAO: mean of the curve over [first_rank, last_rank)
  int last_rank = 829;

  /// Throws OptionError.
  void validate() const;
};

/// Result of a tracker that was started in a frame with the true boxes.
struct BoxTrack {
  int first_frame = 0;
  /// For frames first_frame + 1, + 2, …; empty without an estimate. Frames after the
  /// last true frame are ignored; missing frames at the end count as no estimate.
  std::vector<std::optional<StereoBoxes>> boxes;
};

/// For one track, or for many. NaN for a weight of 0.
struct BoxScores {
  double accuracy = Statistics::kNone;       // mean overlap before the failure
  double robustness_2d = Statistics::kNone;  // hits / (visible frames + excess frames)
  double robustness_3d = Statistics::kNone;
  double error_px = Statistics::kNone;  // of the centres of the boxes, mean of both views
  double error_sd_px = Statistics::kNone;
  double error_mm = Statistics::kNone;
  double error_sd_mm = Statistics::kNone;
  std::size_t frames_2d = 0;      // weight of accuracy and error_px
  std::size_t frames_judged = 0;  // weight of both robustnesses
  std::size_t frames_3d = 0;      // weight of error_mm
};

struct JudgedBoxTrack {
  BoxScores scores;
  std::vector<double> overlaps;  // one per frame up to the last evaluated one; NaN = ignored
};

/// Scores of SurgT (Cartucho et al., 2024) as computed by its script:
/// docs/evaluation.md. Throws InputError if first_frame has no usable truth.
JudgedBoxTrack judgeBoxTrack(const std::vector<BoxTruth>& truth, const BoxTrack& track,
                             const RectifiedRig& rig, const BoxTrackingOptions& options = {});

/// Means weighted by the numbers of frames; sums of the numbers.
BoxScores mergeBoxScores(const std::vector<BoxScores>& scores);

/// Mean of overlap sequences per rank, without ignored values; NaN if all are ignored.
std::vector<double> overlapCurve(const std::vector<std::vector<double>>& sequences);

/// EAO of the curves of all target boxes (one per target: overlapCurve of its tracks).
double expectedAverageOverlap(const std::vector<std::vector<double>>& target_curves,
                              const BoxTrackingOptions& options = {});

/// Intersection over union, 0 to 1.
double boxOverlap(const PixelBox& a, const PixelBox& b);

}  // namespace softscope
