// src/mesh/mesh_formats.h: parsers of each file format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/triangle_mesh.h"

namespace softscope {

/// Content of a file before unit conversion and checks.
struct ParsedMesh {
  TriangleMesh mesh;
  std::string_view comments;  // part of the file that may contain SPACE=LPS and `unit cm`
};

/// All throw InputError that begins with `name`.
ParsedMesh parseStl(std::string_view bytes, const std::string& name);
ParsedMesh parsePly(std::string_view bytes, const std::string& name);
ParsedMesh parseObj(std::string_view bytes, const std::string& name);

/// Detection by the length, which the triangle count determines.
bool isBinaryStl(std::string_view bytes);

/// Splits a polygon into triangles with a common first vertex. None for fewer than three corners.
void addPolygon(const std::vector<std::int32_t>& corners, std::vector<Triangle>& triangles);

}  // namespace softscope
