// src/io/calibrations/one_camera.h: calibrations with one camera, or without calibration.
#pragma once

#include "core/stereo_rig.h"

namespace softscope {

/// Format of a calibration with one camera, for depth files. Both cameras of StereoCalibration
/// are equal, with kAssumedBaselineMm between them: depth needs no baseline, but the errors of
/// a depth file without errors are modelled as those of such a stereo scope.
inline constexpr const char* kOneCameraForm = "one camera";
/// Substitute for a missing calibration: a rectified pair
/// with measurable disparity, without lengths in mm.
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
