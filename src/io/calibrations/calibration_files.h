// src/io/calibrations/calibration_files.h: search of the files of a calibration.
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
  std::vector<std::filesystem::path> files;  // in the order of CalibrationSet
};

/// Finds the other files of a calibration, or the best calibration of a folder. Throws InputError
/// for a folder without a calibration or with several equally good ones, and for missing files.
CalibrationFiles locateCalibration(const std::filesystem::path& file_or_folder);

}  // namespace softscope
