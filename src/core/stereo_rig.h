// src/core/stereo_rig.h: stereo calibration.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "core/camera.h"
#include "core/rectified_rig.h"
#include "core/row_plane.h"

namespace softscope {

/// Calibration from a file; lengths in mm.
struct StereoCalibration {
  RawCamera left;
  RawCamera right;
  /// p_right = right_from_left * p_left, mm (OpenCV's R and T).
  Eigen::Isometry3d right_from_left = Eigen::Isometry3d::Identity();
  bool rectified = false;             // the images on disk are rectified
  double depth_unit_mm = 0.01;        // one step of the 16-bit depth files
  RowPlane rows;                      // remaining after rectification, as measured in a clip
  std::string source;                 // name of the file, for messages
  std::string form;                   // "OpenCV", "Hamlyn", "OpenCAS", "SCARED", "EndoNeRF", "ROS"
  std::vector<std::string> warnings;  // unusual values, one line each

  double baseline_mm() const { return right_from_left.translation().norm(); }
};

}  // namespace softscope
