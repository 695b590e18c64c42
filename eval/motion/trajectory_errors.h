// eval/motion/trajectory_errors.h: errors of the camera path against ground truth.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "eval/statistics/statistics.h"

namespace softscope {

/// One value per pose (or per step), with statistics.
struct PoseErrors {
  std::vector<double> each_mm;   // length of the translation between estimate and truth
  std::vector<double> each_deg;  // angle of the rotation between them, 0 to 180
  Statistics translation_mm;
  Statistics rotation_deg;
};

/// Definitions of evo (Grupp 2017; Sturm et al., IROS 2012): docs/evaluation.md.
struct TrajectoryErrors {
  PoseErrors unaligned;  // both worlds assumed equal
  PoseErrors absolute;   // ATE, SE(3): after the rigid alignment of all positions
  PoseErrors relative;   // RPE, SE(3): steps from each pose to the next; one value
                         // fewer, NaN for steps between frames that are not consecutive
  /// ATE and RPE, Sim(3): the same after alignment with a scale. Not comparable with SE(3): the
  /// scale error, which a stereo camera should not have, is removed. Angles as in `absolute`.
  PoseErrors absolute_scaled;
  PoseErrors relative_scaled;
  double scale = Statistics::kNone;  // of that alignment: truth over estimate; NaN: not unique
  Eigen::Isometry3d truth_from_estimate = Eigen::Isometry3d::Identity();  // that alignment
  /// False if the positions leave a rotation undetermined (static
  /// camera, straight path, fewer than three poses): absolute.each_deg
  /// and absolute.rotation_deg are NaN, and Sim(3) is omitted.
  bool alignment_unique = false;
};

/// world_from_left, mm, per frame. Throws InputError for unequal
/// counts, no poses, and poses that are not finite. `moments`: frame
/// number of each pose, if frames were omitted; empty: none omitted.
TrajectoryErrors trajectoryErrors(const std::vector<Eigen::Isometry3d>& truth,
                                  const std::vector<Eigen::Isometry3d>& estimate,
                                  const std::vector<int>& moments = {});

}  // namespace softscope
