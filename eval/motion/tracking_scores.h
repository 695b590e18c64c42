// eval/motion/tracking_scores.h: the point-tracking scores of the STIR challenges.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// One point in one frame.
struct JudgedPoint {
  double error = 0;  // distance from the true position, in the unit of the thresholds
  bool truly_visible = false;
  bool said_visible = false;
};

/// Over all points. NaN for a denominator of 0. Definitions: docs/evaluation.md.
struct TrackingScores {
  std::size_t count = 0;
  std::vector<double> jaccard_at;                 // TP / (TP + FP + FN), one per threshold
  std::vector<double> accuracy_at;                // share of truly visible points within it
  double average_jaccard = Statistics::kNone;     // AJ: the mean of jaccard_at
  double average_accuracy = Statistics::kNone;    // ATA: the mean of accuracy_at
  double occlusion_accuracy = Statistics::kNone;  // OA: share with correct visibility
};

/// Thresholds of STIR 2026, strict: error < threshold.
std::vector<double> trackingThresholdsPx();
std::vector<double> trackingThresholdsMm();

/// STIR 2026: points of all frames and sequences pooled. Throws InputError
/// for an error that is not finite, OptionError without thresholds.
TrackingScores trackingScores(const std::vector<JudgedPoint>& points,
                              const std::vector<double>& thresholds);

/// STIR up to 2025: end points without identity.
struct EndPointScores {
  std::vector<double> accuracy_at;              // share of distances <= threshold
  double average_accuracy = Statistics::kNone;  // delta_avg: the mean of accuracy_at
  Statistics distance;
};

/// Up to 2025: 4 to 64 px, 2 to 32 mm; distance <= threshold.
std::vector<double> endPointThresholdsPx();
std::vector<double> endPointThresholdsMm();

/// Distance of each estimate to the nearest true end point; positions in the image have
/// z = 0. Throws InputError without true points or for a coordinate that is not finite.
std::vector<double> endPointDistances(const std::vector<Eigen::Vector3d>& estimates,
                                      const std::vector<Eigen::Vector3d>& truth);

/// Over the pooled distances of all clips. Throws OptionError without thresholds.
EndPointScores endPointScores(const std::vector<double>& distances,
                              const std::vector<double>& thresholds);

}  // namespace softscope
