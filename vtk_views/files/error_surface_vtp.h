// vtk_views/files/error_surface_vtp.h: surface
// with errors for ParaView and 3D Slicer.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Computed elsewhere; one per vertex, mm.
struct VertexErrors {
  std::vector<double> signed_mm;  // NaN without a sign
  std::vector<double> absolute_mm;
  std::vector<Eigen::Vector3f> to_reference_mm;  // from the vertex to the closest point
};

/// VTP file (appended, compressed) of the triangles, or of points without triangles, with the
/// arrays `Signed`, `Absolute` (names that scripts of Slicer expect), `ToReference`, and the field
/// array `SPACE` if the mesh has one. Throws Error for inconsistent sizes or a failure of VTK.
std::string errorSurfaceVtp(const TriangleMesh& mesh, const VertexErrors& errors);

}  // namespace softscope
