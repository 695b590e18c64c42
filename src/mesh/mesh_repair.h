// src/mesh/mesh_repair.h: repair to a closed, oriented, manifold surface.
#pragma once

#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

struct RepairedMesh {
  TriangleMesh mesh;
  std::vector<std::string> repairs;  // what was found and done, a line each; empty: as it was
};

/// In this order: joins open edges at the same place, drops folded and doubled triangles, turns
/// triangles that face against their neighbours, parts sheets that touch in a point, closes holes
/// no wider than a third of the mesh, turns what is inside out, drops vertices that nothing names.
/// A mesh that needs nothing keeps its vertices and triangles as they are. Wider holes stay open.
/// Throws InputError, beginning with `name`, where more than two triangles share an edge or the
/// surface has one side only.
RepairedMesh repairMesh(TriangleMesh mesh, const std::string& name);

}  // namespace softscope
