// src/io/calibrations/calibration_parts.h: rows of numbers to cameras and poses, with errors that
// name the cause.
#pragma once

#include <string>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

/// Sets focal length and principal point from the nine numbers of a camera matrix, row by row.
/// `what` names it in errors: "calib.yaml: M1". Throws InputError where it has no such shape.
void setCameraMatrix(PinholeCamera& camera, const std::vector<double>& matrix,
                     const std::string& what);

/// 0, 4, 5, 8, 12 or 14 numbers in OpenCV's order; of 14 the last two (tilt) must be 0.
LensDistortion distortionFrom(const std::vector<double>& values, const std::string& what);

/// A side of an image. Throws InputError where it is no whole number from `least` to a million.
int wholePixels(double value, int least, const std::string& what);

/// A rotation (nine numbers, or three of a rotation vector) and a translation. Numbers rounded in
/// the file are made a rotation again; what is none throws InputError.
Eigen::Isometry3d poseFrom(const std::vector<double>& rotation,
                           const std::vector<double>& translation, const std::string& rotation_what,
                           const std::string& translation_what);

}  // namespace softscope
