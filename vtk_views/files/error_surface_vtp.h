// vtk_views/files/error_surface_vtp.h: a surface with its errors, as ParaView and 3D Slicer read
// it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Computed elsewhere, one a vertex, mm.
struct VertexErrors {
  std::vector<double> signed_mm;  // NaN where no side is outside
  std::vector<double> absolute_mm;
  std::vector<Eigen::Vector3f> to_reference_mm;  // from the vertex to the closest point
};

/// A VTP file (appended, compressed) of the triangles, or of points where there are none, with the
/// arrays `Signed`, `Absolute` (the names that Slicer's scripts look for), `ToReference`, and the
/// field array `SPACE` where the mesh says it. Throws Error where counts differ or VTK can't write.
std::string errorSurfaceVtp(const TriangleMesh& mesh, const VertexErrors& errors);

}  // namespace softscope
