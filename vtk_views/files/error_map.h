// vtk_views/files/error_map.h: a surface at one moment, each of its vertices with its error.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Errors were computed elsewhere. All lengths mm, all places in one frame.
struct ErrorMap {
  TriangleMesh surface;                // without triangles: points
  std::vector<float> absolute_mm;      // one a vertex
  std::vector<float> signed_mm;        // one a vertex, NaN where no side is outside
  std::vector<std::uint8_t> observed;  // one a vertex, 0 = unseen and carried along; may be empty
  TriangleMesh reference;              // coarse, for orientation; may be empty

  int frame = -1;  // -1 = no moment of a series
  double time_s = std::nan("");
  Eigen::Vector3f look{0, 1, 0};  // where an image is best taken: along `look`, `up` upwards
  Eigen::Vector3f up{0, 0, 1};    // (defaults: the front of a patient in LPS)
};

/// A VTP file: the surface's vertices (as points where it has no triangles) with the arrays
/// Absolute, Signed and Observed, then the reference's triangles, whose errors are NaN; field
/// arrays ModelPoints (how many vertices are the surface's), Frame, TimeValue, Look, Up, SPACE.
/// Throws Error where counts differ.
std::string errorMapVtp(const ErrorMap& map);

/// Reads what errorMapVtp or errorSurfaceVtp made. `name`: in messages. Throws InputError.
ErrorMap parseErrorMap(const std::string& bytes, const std::string& name);

}  // namespace softscope
