// tests/mesh/open_mesh_check.h: OpenMesh's opinion of a surface.
#pragma once

#include <string>

#include "core/triangle_mesh.h"

namespace softscope::test {

/// Empty where OpenMesh takes every triangle and finds every vertex manifold; else what it
/// dislikes. It refuses a side that has two triangles already, or that neighbours run through the
/// same way.
std::string openMeshComplaint(const TriangleMesh& mesh);

}  // namespace softscope::test
