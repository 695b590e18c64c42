// src/mesh/mesh_formats.h: one parser a file format; readMesh chooses and checks.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// What a file holds, before units and plausibility are looked at.
struct ParsedMesh {
  TriangleMesh mesh;
  std::string_view comments;  // the part of the file where SPACE=LPS may stand
};

/// All throw InputError that begins with `name`.
ParsedMesh parseStl(std::string_view bytes, const std::string& name);
ParsedMesh parsePly(std::string_view bytes, const std::string& name);
ParsedMesh parseObj(std::string_view bytes, const std::string& name);

/// A binary STL has no mark but its length, which its count of triangles must explain.
bool isBinaryStl(std::string_view bytes);

/// Cuts a polygon into triangles that share its first vertex. Fewer than three corners give none.
void addPolygon(const std::vector<std::int32_t>& corners, std::vector<Triangle>& triangles);

}  // namespace softscope
