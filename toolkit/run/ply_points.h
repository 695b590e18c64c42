// toolkit/run/ply_points.h: a PLY file of points without triangles, as `depth` and `reconstruct`
// write it.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

struct PlyPoints {
  std::uint64_t count = 0;
  std::vector<std::string> properties;  // of a point: "x", "y", "z", "nx" …
  std::vector<std::string> comments;    // of the header: which frame, which space
  Eigen::AlignedBox3d box_mm;           // of the finite points; empty if there are none
  std::uint64_t invalid = 0;            // points that are not finite
};

/// True where the file is a PLY whose header promises no faces.
bool isPlyOfPoints(std::string_view bytes, const std::string& name);

/// Throws InputError where the header is broken, x y z are missing, or the data are cut short.
PlyPoints describePlyPoints(std::string_view bytes, const std::string& name);

}  // namespace softscope
