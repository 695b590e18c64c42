// src/io/calibrations/shipped_calibrations.h: calibrations
// in the formats of data sets, for simulated clips.
#pragma once

#include <string>

#include "core/stereo_rig.h"

namespace softscope {

// readCalibration() reads all of them.

/// SERV-CT: P1 and P2 of rectified cameras.
std::string projectionJson(const StereoCalibration& calibration);
/// StereoMIS: five coefficients per lens; throws OptionError for more.
std::string calibrationIni(const StereoCalibration& calibration);
/// ROS camera_info of one of two rectified cameras, metres.
std::string cameraInfoYaml(const StereoCalibration& calibration, bool right);
/// STIR up to 2025, metres.
std::string firstStirCalibrationJson(const StereoCalibration& calibration);

}  // namespace softscope
