// src/pipeline/frame/pose_summary.h: what stage 4 found of the scope's pose.
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <string>

#include "pipeline/frame/depth_summary.h"

namespace softscope {

struct PoseSummary {
  bool found = false;
  std::string failure;  // why not; empty where found
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  int inliers = 0;
  double rms_mm = kUnknown;
  bool scope_static = false;    // no significant motion since the reference pose
  bool keeps_shape = true;      // the tissue still has its reference shape, as far as is known
  double moved_mm = kUnknown;   // measured motion since the reference pose
  double sigma_mm = kUnknown;   // predicted standard error of the position …
  double sigma_deg = kUnknown;  // … and of the orientation
};

}  // namespace softscope
