// src/io/calibrations/calibration_writer.h: a calibration in the form of docs/formats.md,
// "calibration.yaml".
#pragma once

#include <filesystem>
#include <string>

#include "core/stereo_rig.h"

namespace softscope {

/// OpenCV YAML: image_width, image_height, unit (mm), rectified, depth_unit_mm, M1 D1 M2 D2 R T.
/// Reads back as the same numbers, bit by bit.
std::string calibrationYaml(const StereoCalibration& calibration);

/// Throws OptionError where the file exists and `overwrite` is false, Error where it can't be
/// written.
void writeCalibration(const std::filesystem::path& file, const StereoCalibration& calibration,
                      bool overwrite = false);

}  // namespace softscope
