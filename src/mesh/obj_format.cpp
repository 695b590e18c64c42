// src/mesh/obj_format.cpp: Wavefront OBJ: lines v and f; materials are ignored.
#include <cmath>

#include "mesh/mesh_formats.h"
#include "mesh/text_scanner.h"

namespace softscope {
namespace {

std::uint8_t toByte(float share) {
  const float value = std::round(share * 255);
  return static_cast<std::uint8_t>(value > 0 ? (value < 255 ? value : 255) : 0);
}

/// v x y z [w], or v x y z red green blue with colours from 0 to 1.
void parseVertex(std::string_view line, const TextScanner& file, TriangleMesh& mesh) {
  TextScanner words(line, "");
  float values[6] = {};
  int count = 0;
  for (std::string_view word = words.word(); !word.empty() && count < 6; word = words.word())
    values[count++] = static_cast<float>(file.toNumber<double>(word));
  if (count < 3) file.fail("a vertex has " + std::to_string(count) + " coordinates, not three");
  mesh.vertices_mm.emplace_back(values[0], values[1], values[2]);
  if (count == 6) mesh.colours.push_back({toByte(values[3]), toByte(values[4]), toByte(values[5])});
}

/// f a b c …, each `v`, `v/vt`, `v//vn` or `v/vt/vn`; indices from 1, or negative from the end.
void parseFace(std::string_view line, const TextScanner& file, TriangleMesh& mesh) {
  TextScanner words(line, "");
  const auto count = static_cast<std::int64_t>(mesh.vertices_mm.size());
  std::vector<std::int32_t> corners;
  for (std::string_view word = words.word(); !word.empty(); word = words.word()) {
    const auto index = file.toNumber<std::int64_t>(word.substr(0, word.find('/')));
    const std::int64_t vertex = index > 0 ? index - 1 : count + index;
    if (index == 0 || index > INT32_MAX || vertex < 0)
      file.fail("a face names vertex " + std::to_string(index) + ", but " + std::to_string(count) +
                " came before, counted from 1");
    corners.push_back(static_cast<std::int32_t>(vertex));
  }
  if (corners.size() < 3)
    file.fail("a face has " + std::to_string(corners.size()) + " corners, not three or more");
  addPolygon(corners, mesh.triangles);
}

}  // namespace

ParsedMesh parseObj(std::string_view bytes, const std::string& name) {
  ParsedMesh parsed;
  TextScanner file(bytes, name);
  bool in_head = true;
  while (!file.atEnd()) {
    const std::string_view key = file.word();
    const std::size_t end_of_word = file.position();
    const TextScanner here = file;  // for errors: position of the line
    std::string_view rest = file.restOfLine();
    rest = rest.substr(0, rest.find('#'));
    in_head = in_head && key[0] == '#';
    if (in_head) parsed.comments = bytes.substr(0, end_of_word + rest.size());
    if (key == "v") parseVertex(rest, here, parsed.mesh);
    if (key == "f") parseFace(rest, here, parsed.mesh);
  }
  if (parsed.mesh.colours.size() != parsed.mesh.vertices_mm.size()) parsed.mesh.colours.clear();
  return parsed;
}

}  // namespace softscope
