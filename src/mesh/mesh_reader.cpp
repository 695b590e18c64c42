// src/mesh/mesh_reader.cpp: selection of the parser, checks, unit and space.
#include "mesh/mesh_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

#include "core/error.h"
#include "mesh/mesh_formats.h"
#include "mesh/text_scanner.h"

namespace softscope {
namespace {

constexpr float kFarthestUnscaledMm = 1e7f;  // limit for micrometres read as mm

namespace fs = std::filesystem;

constexpr std::uintmax_t kLimitBytes = std::uintmax_t{2} << 30;

std::string readBytes(const fs::path& file) {
  const std::string name = file.string();
  std::error_code code;
  const fs::file_status status = fs::status(file, code);
  if (status.type() == fs::file_type::not_found)
    throw InputError(name + ": there is no such file; check the path");
  if (code) throw InputError(name + ": can't be looked at: " + code.message());
  if (!fs::is_regular_file(status))
    throw InputError(name + ": not a regular file; give a mesh in STL, PLY or OBJ");
  const std::uintmax_t size = fs::file_size(file, code);
  if (code || size > kLimitBytes)
    throw InputError(name + ": more than " + std::to_string(kLimitBytes >> 20) +
                     " MB; is it a mesh? Then reduce its triangles");
  std::string bytes(size, '\0');
  std::ifstream stream(file, std::ios::binary);
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(size)))
    throw InputError(name + ": can't be read; check its rights");
  return bytes;
}

/// True if the first line with content begins like an OBJ file.
bool looksLikeObj(std::string_view bytes) {
  TextScanner scanner(bytes.substr(0, std::min<std::size_t>(bytes.size(), 1 << 16)), "");
  while (!scanner.atEnd()) {
    const std::string_view word = scanner.word();
    if (word[0] != '#')
      for (const char* key : {"v", "vn", "vt", "vp", "f", "o", "g", "s", "mtllib", "usemtl"})
        if (word == key) return true;
    if (word[0] != '#') return false;
    scanner.restOfLine();
  }
  return false;
}

ParsedMesh parse(std::string_view bytes, const std::string& name) {
  if (bytes.empty()) throw InputError(name + ": the file is empty; export the mesh again");
  if (bytes.substr(0, 4) == "ply\n" || bytes.substr(0, 4) == "ply\r") return parsePly(bytes, name);
  if (!isBinaryStl(bytes) && looksLikeObj(bytes)) return parseObj(bytes, name);
  return parseStl(bytes, name);
}

/// LPS or RAS after SPACE=, empty if absent.
std::string spaceOf(std::string_view comments, const std::string& name) {
  constexpr std::string_view kKey = "SPACE=";
  for (std::size_t at = comments.find(kKey); at != std::string_view::npos;
       at = comments.find(kKey, at + 1)) {
    const char before = at == 0 ? ' ' : comments[at - 1];
    if (std::isalnum(static_cast<unsigned char>(before)) || before == '_') continue;
    const std::string_view value = comments.substr(at + kKey.size(), 3);
    if (value == "LPS" || value == "RAS") return std::string(value);
    throw InputError(name + ": the header says SPACE=" + TextScanner::shownWord(value) +
                     ", but LPS or RAS are understood; mend the comment");
  }
  return "";
}

void requireTriangles(const TriangleMesh& mesh, const std::string& name) {
  if (!mesh.triangles.empty()) return;
  throw InputError(name + ": no triangles among " + std::to_string(mesh.vertices_mm.size()) +
                   " vertices; a cloud of points? Give a surface");
}

void requireIndices(const TriangleMesh& mesh, const std::string& name) {
  const std::int32_t count = static_cast<std::int32_t>(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (const std::int32_t vertex : mesh.triangles[i])
      if (vertex < 0 || vertex >= count)
        throw InputError(name + ": triangle " + std::to_string(i) + " names vertex " +
                         std::to_string(vertex) + ", but there are " + std::to_string(count) +
                         ", counted from 0; export the mesh again");
}

void requireFinite(const TriangleMesh& mesh, const std::string& name) {
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i)
    if (mesh.vertices_mm[i].allFinite() &&
        mesh.vertices_mm[i].cwiseAbs().maxCoeff() > kFarthestUnscaledMm)
      throw InputError(
          name + ": vertex " + std::to_string(i) +
          " lies more than 10 km from the origin; in another unit than mm, or damaged?");
    else if (!mesh.vertices_mm[i].allFinite())
      throw InputError(name + ": vertex " + std::to_string(i) +
                       " has a coordinate that is not a finite number; repair the mesh");
}

}  // namespace

void MeshReadOptions::validate() const {
  require(std::isnan(unit_mm) || (unit_mm > 0 && std::isfinite(unit_mm)), "unit_mm", unit_mm,
          "must be above 0");
}

TriangleMesh parseMesh(std::string_view bytes, const std::string& name,
                       const MeshReadOptions& options) {
  options.validate();
  ParsedMesh parsed = parse(bytes, name);
  TriangleMesh& mesh = parsed.mesh;
  mesh.unit_mm = unitOfFileMm(options.unit_mm, parsed.comments);
  toMillimetres(mesh.unit_mm, &mesh.vertices_mm);
  requireTriangles(mesh, name);
  requireIndices(mesh, name);
  requireFinite(mesh, name);
  mesh.space = spaceOf(parsed.comments, name);
  return std::move(parsed.mesh);
}

TriangleMesh readMesh(const fs::path& file, const MeshReadOptions& options) {
  options.validate();
  return parseMesh(readBytes(file), file.string(), options);
}

void addPolygon(const std::vector<std::int32_t>& corners, std::vector<Triangle>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

}  // namespace softscope
