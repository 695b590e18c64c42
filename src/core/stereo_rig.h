// src/core/stereo_rig.h: two cameras on one scope.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/camera.h"

namespace softscope {

/// A calibration as it was read; lengths already in mm.
struct StereoCalibration {
  RawCamera left;
  RawCamera right;
  /// p_right = right_from_left * p_left, mm (OpenCV's R and T).
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  bool rectified = false;             // the pictures on disk are rectified already
  double depth_unit_mm = 0.01;        // one step of the 16-bit depth files
  std::string source;                 // the file it came from, for messages
  std::string form;                   // "OpenCV", "Hamlyn", "OpenCAS", "SCARED", "EndoNeRF", "ROS"
  std::vector<std::string> warnings;  // what is unusual about it, a line each

  double baseline_mm() const { return right_from_left.translation().norm(); }
};

/// The ideal pair after rectification: parallel axes, rows aligned, one focal length.
/// A point at depth z appears in the right picture at
///   u_right = u_left - disparity,  z = focal_px * baseline_mm / (disparity + disparity_offset_px).
struct RectifiedRig {
  PinholeCamera left;
  double baseline_mm = 0;
  double disparity_offset_px = 0;  // cx_right - cx_left; 0 for most rigs
  /// p_rectified = rectified_from_raw_left * p_raw: rotation between the left frames.
  Eigen::Matrix3d rectified_from_raw_left = Eigen::Matrix3d::Identity();

  double depthMm(double disparity_px) const {
    return left.fx_px * baseline_mm / (disparity_px + disparity_offset_px);
  }
  double disparityPx(double depth_mm) const {
    return left.fx_px * baseline_mm / depth_mm - disparity_offset_px;
  }
};

}  // namespace softscope
