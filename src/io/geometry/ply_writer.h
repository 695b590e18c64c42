// src/io/geometry/ply_writer.h: point clouds as PLY.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/point_cloud.h"

namespace softscope {

/// Information on the coordinates in comments of the header.
struct PlyComments {
  std::string frame;  // "left", "raw left", "world", …
  std::string space;  // "LPS" or "RAS" for a cloud in patient space; otherwise empty
  std::vector<std::string> more = {};  // one line each, "time_s 1.52"
};

/// Binary little-endian PLY: x y z (float, mm), then nx ny nz (float), red green blue (uchar),
/// weight and sigma_mm (float) if the cloud has them. A normal that is not finite is written
/// as 0 0 0. Throws Error unless there is one normal, colour, weight and sigma per point.
std::string plyBytes(const PointCloud& cloud, const PlyComments& comments);

/// Throws OptionError if the file exists and
/// `overwrite` is false, Error if it cannot be written.
void writePly(const std::filesystem::path& file, const PointCloud& cloud,
              const PlyComments& comments, bool overwrite = false);

}  // namespace softscope
