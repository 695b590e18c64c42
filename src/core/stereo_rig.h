// src/core/stereo_rig.h: two cameras on one scope.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/rectified_rig.h"

namespace softscope {

/// A calibration as it was read; lengths already in mm.
struct StereoCalibration {
  RawCamera left;
  RawCamera right;
  /// p_right = right_from_left * p_left, mm (OpenCV's R and T).
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  bool rectified = false;             // the images on disk are rectified already
  double depth_unit_mm = 0.01;        // one step of the 16-bit depth files
  std::string source;                 // the file it came from, for messages
  std::string form;                   // "OpenCV", "Hamlyn", "OpenCAS", "SCARED", "EndoNeRF", "ROS"
  std::vector<std::string> warnings;  // what is unusual about it, a line each

  double baseline_mm() const { return right_from_left.translation().norm(); }
};

}  // namespace softscope
