// src/io/calibrations/calibration_writer.h: writer of calibration.yaml
// (docs/formats.md).
#pragma once

#include <filesystem>
#include <string>

#include "core/stereo_rig.h"

namespace softscope {

/// OpenCV YAML: image_width, image_height, unit (mm),
/// rectified, depth_unit_mm, M1 D1 M2 D2 R T. Exact round trip.
std::string calibrationYaml(const StereoCalibration& calibration);

/// Throws OptionError if the file exists and
/// `overwrite` is false, Error if it cannot be written.
void writeCalibration(const std::filesystem::path& file, const StereoCalibration& calibration,
                      bool overwrite = false);

}  // namespace softscope
