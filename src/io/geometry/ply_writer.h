// src/io/geometry/ply_writer.h: point clouds as PLY.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/point_cloud.h"

namespace softscope {

/// What the header's comments say of the coordinates.
struct PlyComments {
  std::string frame;  // "left", "raw left", "world", …
  std::string space;  // "LPS" or "RAS" where the cloud lies in a patient's space; else empty
  std::vector<std::string> more = {};  // one line each, "time_s 1.52"
};

/// Binary little-endian PLY: x y z (float, mm), then nx ny nz (float), red green blue (uchar),
/// weight and sigma_mm (float) where the cloud has them. A normal that isn't finite is written as
/// 0 0 0. Throws Error where normals, colours, weights or sigmas aren't one a point.
std::string plyBytes(const PointCloud& cloud, const PlyComments& comments);

/// Throws OptionError where the file exists and `overwrite` is false, Error where it can't be
/// written.
void writePly(const std::filesystem::path& file, const PointCloud& cloud,
              const PlyComments& comments, bool overwrite = false);

}  // namespace softscope
