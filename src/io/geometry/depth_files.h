// src/io/geometry/depth_files.h: reading and writing of depth and disparity maps.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/raster.h"

namespace softscope {

/// What one step of a 16-bit disparity file is worth.
inline constexpr double kDisparityStepPx = 1.0 / 256;

/// Depth in mm from a 16-bit PNG or TIFF (one step = `unit_mm`, 0 = none), a PFM or a 32-bit float
/// TIFF (both mm), or a NumPy array of floats (.npy, metres). What isn't positive and finite
/// becomes NaN. Throws InputError.
Raster<float> readDepth(const std::filesystem::path& file, double unit_mm = 0.01);
Raster<float> parseDepth(std::string_view bytes, const std::string& name, double unit_mm = 0.01);

/// Disparity in px from a 16-bit PNG (one step = 1/256 px, 0 = none), a PFM or a 32-bit float TIFF.
/// Throws InputError.
Raster<float> readDisparity(const std::filesystem::path& file);
Raster<float> parseDisparity(std::string_view bytes, const std::string& name);

// All writers throw OptionError where the file exists and `overwrite` is false, Error where it
// can't be written. What a 16-bit file can't hold (NaN, 0 or less, more than 65535 steps) is
// written as 0, which says "none".
void writeDepthPng(const std::filesystem::path& file, const Raster<float>& depth_mm,
                   double unit_mm = 0.01, bool overwrite = false);
/// As PNG.
void writeDepthTiff(const std::filesystem::path& file, const Raster<float>& depth_mm,
                    double unit_mm, bool overwrite = false);
void writeDisparityPng(const std::filesystem::path& file, const Raster<float>& disparity_px,
                       bool overwrite = false);

/// 32-bit floats as they are, NaN included: depth in mm, disparity in px, or whatever else.
void writePfm(const std::filesystem::path& file, const Raster<float>& raster,
              bool overwrite = false);
void writeDepthNpy(const std::filesystem::path& file, const Raster<float>& depth_mm,
                   bool overwrite = false);  // in metres

}  // namespace softscope
