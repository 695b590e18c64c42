// src/mesh/mesh_repair.h: repair to a closed, oriented, manifold surface.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::string> repairs;  // defects and repairs, one line each; empty: unchanged
};

/// In this order: merges open edges at the same position, drops degenerate and
/// duplicate triangles, orients triangles consistently, separates sheets that
/// touch in a point, closes holes no wider than a third of the mesh, reverses
/// an inside-out mesh, drops unused vertices. A valid mesh is unchanged. Wider
/// holes stay open. Throws InputError that begins with `name` if more than two
/// triangles share an edge or the surface is not orientable.
RepairedMesh repairMesh(TriangleMesh mesh, const std::string& name);

}  // namespace softscope
