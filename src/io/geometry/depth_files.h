// src/io/geometry/depth_files.h: reader and writer of depth and disparity maps.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/raster.h"

namespace softscope {

/// Step of a 16-bit disparity file.
inline constexpr double kDisparityStepPx = 1.0 / 256;
inline constexpr double kServCtStepMm = 1.0 / 256;  // of the depth images of SERV-CT

/// Depth in mm from a 16-bit PNG or TIFF (step `unit_mm`, 0 = none), a PFM or
/// a 32-bit float TIFF (both mm), or a NumPy array of floats (.npy, metres).
/// Values that are not positive and finite become NaN. Throws InputError.
Raster<float> readDepth(const std::filesystem::path& file, double unit_mm = 0.01);
Raster<float> parseDepth(std::string_view bytes, const std::string& name, double unit_mm = 0.01);

/// Disparity in px from a 16-bit PNG (step 1/256 px, 0 =
/// none), a PFM or a 32-bit float TIFF. Throws InputError.
Raster<float> readDisparity(const std::filesystem::path& file);
Raster<float> parseDisparity(std::string_view bytes, const std::string& name);

// All writers throw OptionError if the file exists and `overwrite` is false,
// Error if it cannot be written. Values outside of the 16-bit range (NaN, 0
// or less, more than 65535 steps) are written as 0, which means "none".
void writeDepthPng(const std::filesystem::path& file, const Raster<float>& depth_mm,
                   double unit_mm = 0.01, bool overwrite = false);
/// As PNG.
void writeDepthTiff(const std::filesystem::path& file, const Raster<float>& depth_mm,
                    double unit_mm, bool overwrite = false);
void writeDisparityPng(const std::filesystem::path& file, const Raster<float>& disparity_px,
                       bool overwrite = false);

/// 32-bit floats unchanged, including NaN: depth in mm, disparity in px, or other values.
void writePfm(const std::filesystem::path& file, const Raster<float>& raster,
              bool overwrite = false);
void writeDepthNpy(const std::filesystem::path& file, const Raster<float>& depth_mm,
                   bool overwrite = false);  // in metres

}  // namespace softscope
