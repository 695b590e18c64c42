// src/io/calibrations/calibration_files.h: the files of a calibration.
#pragma once

#include <filesystem>
#include <vector>

namespace softscope {

enum class CalibrationSet {
  kOneFile,
  kOpenCvTwo,    // intrinsics, extrinsics
  kRosPair,      // left, right
  kHamlynThree,  // left, right, extrinsics
  kOpenCasFive   // left intrinsics, left distortion, right intrinsics, right distortion, l2r
};

struct CalibrationFiles {
  CalibrationSet set = CalibrationSet::kOneFile;
  std::vector<std::filesystem::path> files;  // in the order given above
};

/// Finds the files beside a named one, or the best calibration of a folder. Throws InputError
/// where a folder holds none, or several of which none is better, or a partner is missing.
CalibrationFiles locateCalibration(const std::filesystem::path& file_or_folder);

}  // namespace softscope
