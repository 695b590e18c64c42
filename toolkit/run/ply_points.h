// toolkit/run/ply_points.h: PLY file of points without
// triangles, as written by `depth` and `reconstruct`.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

struct PlyPoints {
  std::uint64_t count = 0;
  std::vector<std::string> properties;  // of a vertex: "x", "y", "z", "nx" …
  std::vector<std::string> comments;    // of the header: frame, space
  Eigen::AlignedBox3d box_mm;           // of the finite points; empty without any
  std::uint64_t invalid = 0;            // points that are not finite
};

/// True for a PLY whose header has no faces.
bool isPlyOfPoints(std::string_view bytes, const std::string& name);

/// Throws InputError for a damaged header, missing x y z, or truncated data.
PlyPoints describePlyPoints(std::string_view bytes, const std::string& name);

}  // namespace softscope
