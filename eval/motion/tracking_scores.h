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

/// Of all points together. NaN where a denominator is 0. Definitions: docs/evaluation.md.
struct TrackingScores {
  std::size_t count = 0;
  std::vector<double> jaccard_at;               // TP / (TP + FP + FN), one a threshold
  std::vector<double> accuracy_at;              // share of truly visible points within a threshold
  double average_jaccard = Statistics::kNone;   // AJ: the mean of jaccard_at
  double average_accuracy = Statistics::kNone;  // ATA: the mean of accuracy_at
  double occlusion_accuracy = Statistics::kNone;  // OA: share whose visibility is right
};

/// STIR 2026's thresholds; a point is within one where its error is less (strictly).
std::vector<double> trackingThresholdsPx();
std::vector<double> trackingThresholdsMm();

/// STIR 2026: points of all frames and sequences in one pool. Throws InputError for an error that
/// is not finite, OptionError where there is no threshold.
TrackingScores trackingScores(const std::vector<JudgedPoint>& points,
                              const std::vector<double>& thresholds);

/// STIR to 2025: end points without identity.
struct EndPointScores {
  std::vector<double> accuracy_at;              // share of distances <= a threshold
  double average_accuracy = Statistics::kNone;  // delta_avg: the mean of accuracy_at
  Statistics distance;
};

/// To 2025: 4 to 64 px, 2 to 32 mm; a point is within a threshold where its distance is not more.
std::vector<double> endPointThresholdsPx();
std::vector<double> endPointThresholdsMm();

/// Distance of each estimate from the nearest true end point; positions in the image have z = 0.
/// Throws InputError where there is no true point or a coordinate is not finite.
std::vector<double> endPointDistances(const std::vector<Eigen::Vector3d>& estimates,
                                      const std::vector<Eigen::Vector3d>& truth);

/// Of the distances of all clips in one pool. Throws OptionError where there is no threshold.
EndPointScores endPointScores(const std::vector<double>& distances,
                              const std::vector<double>& thresholds);

}  // namespace softscope
