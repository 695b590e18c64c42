// src/io/calibrations/calibration_check.h: plausibility of a calibration for an endoscope.
#pragma once

#include <string>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

/// What an endoscope's calibration is like. Outside the hard limits it is an error, outside the
/// usual ones a warning.
struct CalibrationLimits {
  double least_baseline_mm = 0.2, usual_least_baseline_mm = 1;
  double most_baseline_mm = 60, usual_most_baseline_mm = 20;
  double usual_least_view_deg = 20, usual_most_view_deg = 120;  // field of view, horizontal
  double usual_most_convergence_deg = 15;                       // angle between the cameras
  double usual_most_aspect = 1.25;                              // fx / fy, or its inverse
  double most_focal_px = 1e6;                                   // the largest image sees 1°
};

/// Checks everything that needs no image size. Throws InputError where it can't be right: focal
/// length, principal point, baseline, side of the right camera, a flag `rectified` that the numbers
/// contradict, depth unit. Returns what is unusual, a line each. `unit` is the file's, for a guess
/// at what went wrong.
std::vector<std::string> checkCalibration(const StereoCalibration& calibration,
                                          const std::string& unit = "mm");

/// Checks size, field of view and principal point; nothing while the size is 0 (unknown).
/// Throws InputError on a size that no image has or that differs between the cameras.
std::vector<std::string> checkPictureFit(const StereoCalibration& calibration);

}  // namespace softscope
