// vtk_views/files/error_map.h: surface with an error per vertex, for one frame.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Computed elsewhere. All lengths in mm, all positions in one frame.
struct ErrorMap {
  TriangleMesh surface;                // without triangles: a point cloud
  std::vector<float> absolute_mm;      // one per vertex
  std::vector<float> signed_mm;        // one per vertex, NaN without a sign
  std::vector<std::uint8_t> observed;  // one per vertex, 0 = currently not observed; may be empty
  TriangleMesh reference;              // decimated, for orientation; may be empty

  int frame = -1;  // -1 = not part of a series
  double time_s = std::nan("");
  Eigen::Vector3f look{0, 1, 0};  // initial view direction, with `up`
  Eigen::Vector3f up{0, 0, 1};    // (defaults: the front of a patient in LPS)
};

/// VTP file: vertices of the surface (as points without triangles) with the
/// arrays Absolute, Signed and Observed, then the triangles of the reference with
/// NaN as error; field arrays ModelPoints (number of vertices of the surface),
/// Frame, TimeValue, Look, Up, SPACE. Throws Error for inconsistent sizes.
std::string errorMapVtp(const ErrorMap& map);

/// Parses the result of errorMapVtp() or errorSurfaceVtp(). `name`: in messages. Throws InputError.
ErrorMap parseErrorMap(const std::string& bytes, const std::string& name);

}  // namespace softscope
