// src/core/rectified_rig.h: ideal camera pair after rectification.
#pragma once

#include <Eigen/Core>

#include "core/camera.h"
#include "core/hd.h"

namespace softscope {

/// Ideal pair after rectification: parallel axes, aligned rows, equal focal
/// lengths. A point at depth z appears in the right image at u_right = u_left -
/// disparity,  z = focal_px * baseline_mm / (disparity + disparity_offset_px).
struct RectifiedRig {
  PinholeCamera left;
  double baseline_mm = 0;
  double disparity_offset_px = 0;  // cx_right - cx_left; 0 for most rigs
  /// p_rectified = rectified_from_raw_left * p_raw: rotation between the left frames.
  Eigen::Matrix3d rectified_from_raw_left = Eigen::Matrix3d::Identity();

  SOFTSCOPE_HD double depthMm(double disparity_px) const {
    return left.fx_px * baseline_mm / (disparity_px + disparity_offset_px);
  }
  SOFTSCOPE_HD double disparityPx(double depth_mm) const {
    return left.fx_px * baseline_mm / depth_mm - disparity_offset_px;
  }
};

}  // namespace softscope
