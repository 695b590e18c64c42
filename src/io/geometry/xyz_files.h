// src/io/geometry/xyz_files.h: scene point per pixel, as in SCARED.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>

#include "core/raster.h"
#include "core/rectified_rig.h"

namespace softscope {

/// x, y, z in mm in the frame of the raw left camera; NaN if unknown.
using PointRaster = Raster<Eigen::Vector3f>;

/// TIFF with three 32-bit float channels. A point with z = 0,
/// or one that is not finite, becomes NaN. Throws InputError.
PointRaster readPointRaster(const std::filesystem::path& file);
PointRaster parsePointRaster(std::string_view bytes, const std::string& name);
/// NaN is preserved. Throws OptionError if the file exists and `overwrite` is false.
void writePointRaster(const std::filesystem::path& file, const PointRaster& points,
                      bool overwrite = false);

/// Depth map of the rectified left camera, mm: each point is rotated into its frame
/// and projected; the nearest one per pixel is kept. The raw map is not resampled,
/// because interpolation across depth discontinuities would create false points.
Raster<float> rectifiedDepth(const PointRaster& points, const RectifiedRig& rig);

}  // namespace softscope
