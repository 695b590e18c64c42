// src/pose/refine_pose.h: the rigid motion that most of the tissue agrees with, to sub-pixel.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

struct RefinePoseOptions {
  int iterations = 20;
  double noise_px = 0.1;             // floor of what matching and the model's places err by
  double disparity_noise_px = 0.25;  // floor of what the live disparity errs by
  double robust_scale = 1.5;         // of the median residual: what moves more is tissue
  double standing_mm = 2.0;          // where less than this moved across the rays, and …
  double standing_share = 0.15;      // … a rigid motion leaves more than this share of it, the
                                     // scope stands still and the tissue moves, …
  double moving_share = 0.8;         // … but where one motion explains so many pairs, and none
                                     // less than half as many, the scope moves all the same

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// One piece of tissue on the model and in the live picture.
struct PosePair {
  Eigen::Vector3d model_world_mm;
  Eigen::Vector2d live_px;
  double sigma_px = 0;
  double disparity_px = 0;  // measured, live
  double sigma_disparity_px = 0;
};

struct RefinedPose {
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  bool stands = false;  // the scope is where it was
  /// By how much the frame's disparities exceed the model's, in the median; 0 unless it stands.
  double disparity_offset_px = 0;
  double moved_mm = 0;  // across the rays, seen from `last`: the median
  double left_mm = 0;   // seen from the pose with the least cost
};

/// Iteratively reweighted Gauss-Newton over the pose: docs/energy.md (26) to (29). Pixels pin it a
/// hundred times better than depths do, and pairs on tissue that moves by itself lose their weight
/// (Geman and McClure). It starts from `fitted` and from `last`, where the scope was; the better
/// end counts. Pairs that are not finite or behind the camera have no weight; fewer than three
/// leave `fitted`. Throws OptionError on bad options.
RefinedPose refinePose(const std::vector<PosePair>& pairs, const RectifiedRig& rig,
                       const Eigen::Isometry3d& fitted, const Eigen::Isometry3d& last,
                       const RefinePoseOptions& options);

}  // namespace softscope
