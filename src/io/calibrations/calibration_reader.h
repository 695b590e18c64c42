// src/io/calibrations/calibration_reader.h: stereo calibration of both cameras, from a file of any
// supported format.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/stereo_rig.h"

namespace softscope {

/// What a calibration file may leave unsaid.
struct CalibrationHints {
  std::string image_size;  // "640x480"; empty = the file says it, or the images will
  double baseline_mm = 0;  // 0 = the file says it; else T is scaled to this length
  std::string unit;        // "mm", "cm" or "m"; empty = as the file or its form says
  bool rectified = false;  // the images are rectified, whatever the file says

  /// Width and height of `image_size`; 0 0 where that is empty. Throws OptionError.
  std::pair<int, int> imageSizePx() const;

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// Reads a calibration and checks it (io/calibrations/calibration_check.h); lengths become mm. The
/// form is recognised by content: OpenCV YAML, XML or JSON; OpenCAS and Hamlyn texts; SCARED;
/// EndoNeRF's poses_bounds.npy; a pair of ROS camera_info files. docs/formats.md tells each one
/// exactly. A folder may be given instead of a file; its best calibration is taken. Of forms that
/// spread over several files, any one may be named. Where the file leaves the image's size
/// unsaid, it stays 0. Throws InputError.
StereoCalibration readCalibration(const std::filesystem::path& file_or_folder,
                                  const CalibrationHints& hints = {});

/// The same for a form of one file, from memory; `name` is what messages call it.
StereoCalibration parseCalibration(std::string_view bytes, const std::string& name,
                                   const CalibrationHints& hints = {});

}  // namespace softscope
