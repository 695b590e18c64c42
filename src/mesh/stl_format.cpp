// src/mesh/stl_format.cpp: STL, ascii and binary: triangles without shared vertices.
#include <cctype>
#include <cstring>
#include <unordered_map>

#include "core/error.h"
#include "mesh/mesh_formats.h"
#include "mesh/text_scanner.h"

namespace softscope {
namespace {

constexpr std::size_t kHeaderBytes = 80, kCountBytes = 4, kTriangleBytes = 50;

struct PlaceHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
    std::uint64_t hash = 0;
    for (const std::uint32_t b : bits) hash = (hash ^ b) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

/// Merges corners at the same position, in order of appearance.
class VertexMerger {
 public:
  explicit VertexMerger(TriangleMesh& mesh) : mesh_(mesh) {}

  std::int32_t add(Eigen::Vector3f corner) {
    corner += Eigen::Vector3f::Zero();  // -0 becomes 0: one bit pattern per position
    std::array<std::uint32_t, 3> bits;
    std::memcpy(bits.data(), corner.data(), sizeof bits);
    const auto next = static_cast<std::int32_t>(mesh_.vertices_mm.size());
    const auto [entry, added] = vertices_.emplace(bits, next);
    if (added) mesh_.vertices_mm.push_back(corner);
    return entry->second;
  }

 private:
  TriangleMesh& mesh_;
  std::unordered_map<std::array<std::uint32_t, 3>, std::int32_t, PlaceHash> vertices_;
};

std::uint32_t littleEndian(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

std::string lowerCase(std::string_view word) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// Length of a binary file from its triangle count; 0 if it is too short.
std::uint64_t promisedBytes(std::string_view bytes) {
  if (bytes.size() < kHeaderBytes + kCountBytes) return 0;
  return kHeaderBytes + kCountBytes +
         kTriangleBytes * std::uint64_t{littleEndian(bytes.data() + kHeaderBytes)};
}

ParsedMesh parseBinary(std::string_view bytes) {
  ParsedMesh parsed;
  parsed.comments = bytes.substr(0, kHeaderBytes);
  VertexMerger merger(parsed.mesh);
  const std::size_t count = (bytes.size() - kHeaderBytes - kCountBytes) / kTriangleBytes;
  parsed.mesh.triangles.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const char* corner = bytes.data() + kHeaderBytes + kCountBytes + i * kTriangleBytes + 12;
    Triangle triangle;
    for (std::int32_t& vertex : triangle) {
      Eigen::Vector3f place;
      for (int axis = 0; axis < 3; ++axis, corner += 4) {
        const std::uint32_t pattern = littleEndian(corner);
        std::memcpy(&place[axis], &pattern, sizeof pattern);
      }
      vertex = merger.add(place);
    }
    parsed.mesh.triangles.push_back(triangle);
  }
  return parsed;
}

void expectWord(TextScanner& scanner, const char* expected) {
  const std::string_view found = scanner.word();
  if (lowerCase(found) == expected) return;
  scanner.fail(
      found.empty()
          ? "the text ends where `" + std::string(expected) + "` is expected: the file is truncated"
          : "found " + TextScanner::shownWord(found) + " where `" + expected + "` is expected");
}

Triangle parseFacet(TextScanner& scanner, VertexMerger& merger) {
  expectWord(scanner, "normal");
  for (int axis = 0; axis < 3; ++axis) scanner.word();  // unused; some writers put nan here
  expectWord(scanner, "outer");
  expectWord(scanner, "loop");
  Triangle triangle;
  for (std::int32_t& vertex : triangle) {
    expectWord(scanner, "vertex");
    Eigen::Vector3f place;
    for (int axis = 0; axis < 3; ++axis) place[axis] = static_cast<float>(scanner.number());
    vertex = merger.add(place);
  }
  expectWord(scanner, "endloop");
  expectWord(scanner, "endfacet");
  return triangle;
}

ParsedMesh parseAscii(std::string_view bytes, const std::string& name) {
  ParsedMesh parsed;
  VertexMerger merger(parsed.mesh);
  TextScanner scanner(bytes, name);
  parsed.comments = bytes.substr(0, bytes.find('\n'));
  while (!scanner.atEnd()) {  // a file may contain several solids
    expectWord(scanner, "solid");
    scanner.restOfLine();
    std::string key = lowerCase(scanner.word());
    for (; key == "facet"; key = lowerCase(scanner.word()))
      parsed.mesh.triangles.push_back(parseFacet(scanner, merger));
    if (key.empty()) scanner.fail("the text ends before `endsolid`: the file is truncated");
    if (key != "endsolid")
      scanner.fail("found " + TextScanner::shownWord(key) +
                   " where `facet` or `endsolid` is expected");
    scanner.restOfLine();
  }
  return parsed;
}

}  // namespace

bool isBinaryStl(std::string_view bytes) { return promisedBytes(bytes) == bytes.size(); }

ParsedMesh parseStl(std::string_view bytes, const std::string& name) {
  if (isBinaryStl(bytes)) return parseBinary(bytes);
  const std::uint64_t promised = promisedBytes(bytes);
  TextScanner scanner(bytes, name);
  if (lowerCase(scanner.word()) == "solid") return parseAscii(bytes, name);
  if (promised == 0)
    throw InputError(name + ": neither STL, PLY nor OBJ; give a mesh in one of these formats");
  throw InputError(name + ": no PLY, OBJ or text STL, and as a binary STL it should have " +
                   std::to_string(promised) + " bytes, not " + std::to_string(bytes.size()) +
                   "; truncated? Then export it again");
}

}  // namespace softscope
