// src/pose/refine_pose.h: sub-pixel refinement of the pose, and its standard error.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>
#include <string>
#include <vector>

#include "core/stereo_rig.h"
#include "pose/pose_search.h"

namespace softscope {

struct RefinePoseOptions {
  int iterations = 20;
  static constexpr double kNoisePx = 0.1;  // floor of what matching and the model's places err by
  static constexpr double kDisparityNoisePx = 0.25;  // floor of what the live disparity errs by
  static constexpr double kRobustScale = 1.5;  // of the median residual: what moves more is tissue
  std::string scope = "auto";                  // "static" or "moving" where the user knows
  double significance = 1e-5;  // probability to take a static scope for a moving one

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// One piece of tissue on the model and in the live image.
struct PosePair {
  Eigen::Vector3d model_world_mm;      // in the last frame that was fused
  Eigen::Vector3d reference_world_mm;  // in the reference shape
  Eigen::Vector2d live_px;
  double sigma_px = 0;
  double disparity_px = 0;  // measured, live
  double sigma_disparity_px = 0;
};

struct RefinedPose {
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  bool scope_static = false;  // no significant motion, neither since `last` nor since `reference`
  bool keeps_shape = true;    // as far as is known, the tissue still has its reference shape
  // The rest is NaN where the pairs are too few or too close together.
  double moved_mm = std::numeric_limits<double>::quiet_NaN();   // measured, since `reference`
  double sigma_mm = std::numeric_limits<double>::quiet_NaN();   // predicted standard errors of the
  double sigma_deg = std::numeric_limits<double>::quiet_NaN();  // position and of the orientation
};

/// Iteratively reweighted Gauss-Newton over the pose: docs/energy.md (26) to (28). Pixels pin it a
/// hundred times better than depths do, and pairs on tissue that moves by itself lose their weight
/// (Geman and McClure). It begins at `fitted` and at `last`; the end with the least cost counts.
///
/// The scope moved if a new pose explains the pairs significantly better than the old one, judged
/// by the mean gain of image regions, because tissue that moves pulls whole regions alike: (29).
/// Two motions are tested: since the last fused frame, and, because a slow motion is never
/// significant in one frame, since `reference` and the tissue's places then. As long as most of the
/// tissue has its reference shape, the pose is measured in that shape, significant or not; of
/// tissue that has bent, a motion that is not significant is the tissue's, and the pose is `last`.
/// Pairs that are not finite or behind the camera have no weight; fewer than three are not refined.
/// `search` looks for the poses; by default, the processor.
/// Throws OptionError on bad options.
RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const Eigen::Isometry3d& reference, const RefinePoseOptions& options,
                       PoseSearch* search = nullptr);

/// What refinePose() asks its search.
PoseQuestion poseQuestion(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                          const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                          const Eigen::Isometry3d& reference, const RefinePoseOptions& options);

}  // namespace softscope
