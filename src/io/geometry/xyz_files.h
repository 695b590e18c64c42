// src/io/geometry/xyz_files.h: a point of the scene for each pixel, as SCARED has it.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "core/raster.h"
#include "core/rectified_rig.h"

namespace softscope {

/// x, y, z in mm in the frame of the raw left camera; NaN where nothing is known.
using PointRaster = Raster<Eigen::Vector3f>;

/// A TIFF of three 32-bit float channels. A point with z = 0, or one that isn't finite, becomes
/// NaN. Throws InputError.
PointRaster readPointRaster(const std::filesystem::path& file);
PointRaster parsePointRaster(std::string_view bytes, const std::string& name);
/// NaN stays NaN. Throws OptionError where the file exists and `overwrite` is false.
void writePointRaster(const std::filesystem::path& file, const PointRaster& points,
                      bool overwrite = false);

/// Depth map of the rectified left camera, mm: each point is rotated into its frame, projected, and
/// the nearest one of a pixel stays. The raw map itself is never resampled: across a depth
/// discontinuity that would invent points.
Raster<float> rectifiedDepth(const PointRaster& points, const RectifiedRig& rig);

}  // namespace softscope
