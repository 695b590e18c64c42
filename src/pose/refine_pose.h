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
  static constexpr double kNoisePx = 0.1;  // lower limit of the error of matching and the model
  static constexpr double kDisparityNoisePx = 0.25;  // lower limit of the live disparity's error
  std::string scope = "auto";                        // "static" or "moving" if known
  double significance = 1e-5;  // probability to classify a static scope as moving

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// One point of tissue on the model and in the live image.
struct PosePair {
  Eigen::Vector3d model_world_mm;      // in the last fused frame
  Eigen::Vector3d reference_world_mm;  // in the reference shape
  Eigen::Vector2d live_px;
  double sigma_px = 0;
  double disparity_px = 0;  // measured, live
  double sigma_disparity_px = 0;
};

/// What is known of the scope's motion up to the last fused frame.
enum class ScopeBefore { kStatic, kMoving, kUnclear };

struct RefinedPose {
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  bool scope_static = false;  // no significant motion since `last` and `reference`
  bool keeps_shape = true;    // the tissue still has its reference shape, as far as known
  // The rest is NaN with too few pairs or pairs too close together.
  double moved_mm = std::numeric_limits<double>::quiet_NaN();   // measured, since `reference`
  double sigma_mm = std::numeric_limits<double>::quiet_NaN();   // predicted standard errors of the
  double sigma_deg = std::numeric_limits<double>::quiet_NaN();  // position and of the orientation
};

/// Iteratively reweighted Gauss-Newton over the pose: docs/energy.md (26) to (28).
/// Pixels constrain it a hundred times more than depths, and pairs on moving tissue
/// lose their weight (Geman and McClure). It starts at `fitted` and at `last`; the
/// result with the lower cost counts. The scope moved since the last fused frame if a
/// new pose explains the pairs significantly better than the old one. The test uses the
/// mean gain of image regions, because moving tissue shifts whole regions alike: (29).
/// While most of the tissue has its shape at `reference`, the pose is measured in that
/// shape, significant or not, and the scope moved if it is significantly far away, because
/// a slow motion is never significant in one frame; with deformed tissue, a motion that is
/// not significant is that of the tissue, and the pose is `last`. A scope that moved `before`
/// still moves while its step exceeds a few standard errors; if its state is unknown, it
/// moves. Pairs that are not finite or behind the camera have no weight; fewer than three
/// are not refined. `search` finds the poses; by default, on the CPU. Throws OptionError
/// for invalid options.
RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const Eigen::Isometry3d& reference, ScopeBefore before,
                       const RefinePoseOptions& options, PoseSearch* search = nullptr);

/// Input of the search of refinePose().
PoseQuestion poseQuestion(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                          const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                          const Eigen::Isometry3d& reference, ScopeBefore before,
                          const RefinePoseOptions& options);

}  // namespace softscope
