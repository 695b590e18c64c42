// src/mesh/mesh_reader.h: surfaces from files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace softscope {

struct MeshReadOptions {
  double unit_mm = 1;  // what one unit of the file measures: 1000 for a file in metres

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// Reads STL (ascii or binary), PLY (ascii or binary) or OBJ; the content tells which. Polygons are
/// cut into triangles; triangle i of an STL or of a PLY of triangles is triangle i of the mesh. STL
/// corners at the same place become one vertex. `space` is LPS or RAS where a comment in the
/// header says `SPACE=LPS` or `SPACE=RAS`.
/// Throws InputError for a file that is missing, broken, truncated or has no triangles, for
/// coordinates that are not finite and for vertices that don't exist.
TriangleMesh readMesh(const std::filesystem::path& file, const MeshReadOptions& options = {});

/// The same from memory; `name` is what errors call it.
TriangleMesh parseMesh(std::string_view bytes, const std::string& name,
                       const MeshReadOptions& options = {});

}  // namespace softscope
