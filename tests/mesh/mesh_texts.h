// tests/mesh/mesh_texts.h: one tetrahedron in every form that files take.
#pragma once

#include <string>

#include "core/triangle_mesh.h"

namespace softscope::test {

/// Corners (0 0 0), (1.5 0 0), (0 2 0), (0 0 -3); outwards. Vertices in the order of its triangles.
TriangleMesh tetrahedron();

std::string asciiStl(const TriangleMesh& mesh, const std::string& title = "made");
std::string binaryStl(const TriangleMesh& mesh, const std::string& title = "made");
std::string obj(const TriangleMesh& mesh, const std::string& head = "");
std::string asciiPly(const TriangleMesh& mesh, const std::string& comment = "made");
std::string binaryPly(const TriangleMesh& mesh, bool big_endian,
                      const std::string& comment = "made");

}  // namespace softscope::test
