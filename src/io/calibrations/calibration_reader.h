// src/io/calibrations/calibration_reader.h: reader
// of stereo calibrations of all supported formats.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/stereo_rig.h"

namespace softscope {

/// Values that complete a calibration file.
struct CalibrationHints {
  std::string image_size;  // "640x480"; empty = from the file, or from the images
  double baseline_mm = 0;  // 0 = from the file; else T is scaled to this length
  std::string unit;        // "mm", "cm" or "m"; empty = from the file or its format
  bool rectified = false;  // overrides the file: the images are rectified

  /// Width and height of `image_size`; 0 0 if empty. Throws OptionError.
  std::pair<int, int> imageSizePx() const;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Reads and checks a calibration (io/calibrations/calibration_check.h);
/// lengths are converted to mm. The format is detected from the content: OpenCV
/// YAML, XML or JSON; OpenCAS and Hamlyn texts; SCARED; poses_bounds.npy of
/// EndoNeRF; a pair of ROS camera_info files. Details: docs/formats.md. For a
/// folder, its best calibration is used. Of formats with several files, any one
/// may be given. An unknown image size stays 0. Throws InputError.
StereoCalibration readCalibration(const std::filesystem::path& file_or_folder,
                                  const CalibrationHints& hints = {});

/// The same for a format with one file, from memory; `name` is used in messages.
StereoCalibration parseCalibration(std::string_view bytes, const std::string& name,
                                   const CalibrationHints& hints = {});

}  // namespace softscope
