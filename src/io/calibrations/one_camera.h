// src/io/calibrations/one_camera.h: calibration files of one camera or of none.
#pragma once

#include "core/stereo_rig.h"

namespace softscope {

/// Form of a calibration with one camera, for depth files. Both cameras of StereoCalibration are
/// then that one, kAssumedBaselineMm apart: depth needs no baseline, but the errors of a depth file
/// that says none are taken to grow with depth as those of such a scope do.
inline constexpr const char* kOneCameraForm = "one camera";
/// Form of what stands in for a calibration where none was given: a rectified pair, of which
/// disparity can be measured, and nothing in mm.
inline constexpr const char* kUncalibratedForm = "none";
inline constexpr double kAssumedBaselineMm = 5;

inline bool hasOneCamera(const StereoCalibration& calibration) {
  return calibration.form == kOneCameraForm;
}
inline bool isUncalibrated(const StereoCalibration& calibration) {
  return calibration.form == kUncalibratedForm;
}

/// For a rectified pair of this size without a calibration.
StereoCalibration uncalibrated(int width_px, int height_px);

}  // namespace softscope
