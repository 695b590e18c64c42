// toolkit/run/model_surface.cpp: the surface's vertices are points, named by their places.
#include "toolkit/run/model_surface.h"

#include "core/error.h"
#include "mesh/surface_from_points.h"

namespace softscope {

TriangleMesh modelSurface(const ModelFile& file) {
  TriangleMesh mesh;
  mesh.vertices_mm = file.model.positions_mm;
  if (file.coloured) mesh.colours = file.model.colours;
  if (!file.with_normals) return mesh;
  PointSurface surface;
  try {
    surface = surfaceFromPoints({mesh.vertices_mm, file.model.normals, {}, {}, {}});
  } catch (const InputError&) {
    return mesh;  // too few points, or too far apart: they are shown as points
  }
  for (const auto& triangle : surface.mesh.triangles) {
    mesh.triangles.push_back(triangle);
    for (std::int32_t& vertex : mesh.triangles.back())
      vertex = surface.points[static_cast<std::size_t>(vertex)];
  }
  return mesh;
}

}  // namespace softscope
