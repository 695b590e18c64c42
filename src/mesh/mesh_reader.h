// src/mesh/mesh_reader.h: reader of surfaces.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/length_unit.h"
#include "core/triangle_mesh.h"

namespace softscope {

struct MeshReadOptions {
  double unit_mm = kUnitOfFile;  // length of one unit of the file: 1000 for metres

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Reads STL (ascii or binary), PLY (ascii or binary) or OBJ, detected from the
/// content. Polygons are split into triangles; triangle i of an STL, or of a
/// PLY of triangles, is triangle i of the mesh. Equal corners of an STL become
/// one vertex. `space` is LPS or RAS from a comment `SPACE=LPS` or `SPACE=RAS`
/// in the header. Throws InputError for a missing, damaged or truncated file,
/// no triangles, coordinates that are not finite and invalid indices.
TriangleMesh readMesh(const std::filesystem::path& file, const MeshReadOptions& options = {});

/// The same from memory; `name` is used in errors.
TriangleMesh parseMesh(std::string_view bytes, const std::string& name,
                       const MeshReadOptions& options = {});

}  // namespace softscope
