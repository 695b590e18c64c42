// src/io/calibrations/calibration_check.h: plausibility of a calibration of an endoscope.
#pragma once

#include <string>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

/// Plausible ranges of an endoscope. Values outside of the
/// hard limits are errors, outside of the usual ones warnings.
struct CalibrationLimits {
  double least_baseline_mm = 0.2, usual_least_baseline_mm = 1;
  double most_baseline_mm = 60, usual_most_baseline_mm = 20;
  double likely_least_baseline_mm = 2, likely_most_baseline_mm = 8;  // in a guess at the unit
  double usual_least_view_deg = 20, usual_most_view_deg = 120;       // field of view, horizontal
  double usual_most_convergence_deg = 15;                            // angle between the cameras
  double usual_most_aspect = 1.25;                                   // fx / fy, or its inverse
  double usual_most_tangential = 0.02;                               // |p1|, |p2|
  double most_focal_px = 1e6;                                        // view of 1 degree
};

/// Checks everything independent of the image size. Throws InputError for an
/// impossible focal length, principal point, baseline, side of the right camera
/// or depth unit, or a flag `rectified` that contradicts the numbers. Returns
/// unusual values, one line each. `unit`: unit of the file, for a suggestion.
std::vector<std::string> checkCalibration(const StereoCalibration& calibration,
                                          const std::string& unit = "mm");

/// Checks size, field of view and principal point; skipped for size 0 (unknown).
/// Throws InputError for an implausible size, or for cameras of different sizes.
std::vector<std::string> checkPictureFit(const StereoCalibration& calibration);

/// Warning if the image size, which the file does not give, is probably another one: the
/// principal points of both cameras lie off its middle by the same factor in x and y.
std::vector<std::string> checkAssumedSize(const StereoCalibration& calibration);

}  // namespace softscope
