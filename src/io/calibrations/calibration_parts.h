// src/io/calibrations/calibration_parts.h: conversion of
// numbers to cameras and poses, with specific errors.
#pragma once

#include <string>
#include <vector>

#include "core/stereo_rig.h"

namespace softscope {

/// Sets focal length and principal point from the nine numbers of a camera matrix, row by
/// row. `what`: name in errors: "calib.yaml: M1". Throws InputError for another structure.
void setCameraMatrix(PinholeCamera& camera, const std::vector<double>& matrix,
                     const std::string& what);

/// 0, 4, 5, 8, 12 or 14 numbers in OpenCV's order; the last two of 14 (tilt) must be 0.
LensDistortion distortionFrom(const std::vector<double>& values, const std::string& what);

/// Form of OpenCAS calibrations; their lens model is rational.
inline constexpr const char* kOpenCasForm = "OpenCAS";

/// True if one of k4 k5 k6 is given.
bool isRational(const LensDistortion& distortion);

/// Side of an image. Throws InputError unless it is an integer from `least` to a million.
int wholePixels(double value, int least, const std::string& what);

/// Rotation (nine numbers, or three of a rotation vector) and translation.
/// Rounded matrices are orthonormalised; other matrices throw InputError.
Eigen::Isometry3d poseFrom(const std::vector<double>& rotation,
                           const std::vector<double>& translation, const std::string& rotation_what,
                           const std::string& translation_what);

}  // namespace softscope
