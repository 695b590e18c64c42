// eval/motion/trajectory_errors.h: errors of the scope's path against ground truth.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// One value a pose (or a step between two), and their statistics.
struct PoseErrors {
  std::vector<double> each_mm;   // length of the translation between estimate and truth
  std::vector<double> each_deg;  // angle of the rotation between them, 0 to 180
  Statistics translation_mm;
  Statistics rotation_deg;
};

/// Definitions as evo has them (Grupp 2017; Sturm et al., IROS 2012): docs/evaluation.md.
struct TrajectoryErrors {
  PoseErrors unaligned;  // both worlds taken as one
  PoseErrors absolute;   // ATE, SE(3): after the rigid alignment of all positions
  PoseErrors relative;   // RPE, SE(3): of the steps from each pose to the next; one value fewer,
                         // NaN where these are not of neighbouring moments
  /// ATE and RPE, Sim(3): the same after the alignment with a scale. Not comparable with SE(3): an
  /// error of scale, which a stereo scope should not have, is gone. Angles as `absolute` has them.
  PoseErrors absolute_scaled;
  PoseErrors relative_scaled;
  double scale = Statistics::kNone;  // of that alignment: truth over estimate; NaN: not unique
  Eigen::Isometry3d truth_from_estimate = Eigen::Isometry3d::Identity();  // that alignment
  /// False where the positions leave a rotation free (a still scope, a straight path, fewer than
  /// three poses): then absolute.each_deg and absolute.rotation_deg are NaN, and Sim(3) is left
  /// out.
  bool alignment_unique = false;
};

/// world_from_left, mm, moment by moment. Throws InputError for unequal counts, for none at all,
/// and for poses that are not finite. `moments`: the number of each pose's moment, where some were
/// left out; empty: none was.
TrajectoryErrors trajectoryErrors(const std::vector<Eigen::Isometry3d>& truth,
                                  const std::vector<Eigen::Isometry3d>& estimate,
                                  const std::vector<int>& moments = {});

}  // namespace softscope
