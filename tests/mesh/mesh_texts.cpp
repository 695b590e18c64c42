// tests/mesh/mesh_texts.cpp: writes what the readers shall read.
#include "mesh/mesh_texts.h"

#include <algorithm>
#include <cstring>
#include <sstream>

namespace softscope::test {
namespace {

template <class Value>
void append(std::string& bytes, Value value, bool big_endian = false) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  if (big_endian) std::reverse(raw, raw + sizeof value);
  bytes.append(raw, sizeof value);
}

std::string words(const Eigen::Vector3f& v) {
  std::ostringstream text;
  text << v.x() << " " << v.y() << " " << v.z();
  return text.str();
}

std::string plyHeader(const TriangleMesh& mesh, const std::string& format,
                      const std::string& comment) {
  std::ostringstream text;
  text << "ply\nformat " << format << " 1.0\ncomment " << comment << "\nelement vertex "
       << mesh.vertices_mm.size() << "\nproperty float x\nproperty float y\nproperty float z\n"
       << "element face " << mesh.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  return text.str();
}

}  // namespace

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.vertices_mm = {{0, 0, 0}, {1.5f, 0, 0}, {0, 2, 0}, {0, 0, -3}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  return mesh;
}

std::string asciiStl(const TriangleMesh& mesh, const std::string& title) {
  std::ostringstream text;
  text << "solid " << title << "\n";
  for (const Triangle& t : mesh.triangles) {
    text << "  facet normal 0 0 1\n    outer loop\n";
    for (const int v : t) text << "      vertex " << words(mesh.vertices_mm[v]) << "\n";
    text << "    endloop\n  endfacet\n";
  }
  text << "endsolid " << title << "\n";
  return text.str();
}

std::string binaryStl(const TriangleMesh& mesh, const std::string& title) {
  std::string bytes = title;
  bytes.resize(80, ' ');
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const Triangle& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) append(bytes, 0.0f);
    for (const int v : t)
      for (int axis = 0; axis < 3; ++axis) append(bytes, mesh.vertices_mm[v][axis]);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string obj(const TriangleMesh& mesh, const std::string& head) {
  std::ostringstream text;
  text << head;
  for (const Eigen::Vector3f& v : mesh.vertices_mm) text << "v " << words(v) << "\n";
  for (const Triangle& t : mesh.triangles)
    text << "f " << t[0] + 1 << " " << t[1] + 1 << " " << t[2] + 1 << "\n";
  return text.str();
}

std::string asciiPly(const TriangleMesh& mesh, const std::string& comment) {
  std::ostringstream text;
  text << plyHeader(mesh, "ascii", comment);
  for (const Eigen::Vector3f& v : mesh.vertices_mm) text << words(v) << "\n";
  for (const Triangle& t : mesh.triangles)
    text << "3 " << t[0] << " " << t[1] << " " << t[2] << "\n";
  return text.str();
}

std::string binaryPly(const TriangleMesh& mesh, bool big_endian, const std::string& comment) {
  std::string bytes =
      plyHeader(mesh, big_endian ? "binary_big_endian" : "binary_little_endian", comment);
  for (const Eigen::Vector3f& v : mesh.vertices_mm)
    for (int axis = 0; axis < 3; ++axis) append(bytes, v[axis], big_endian);
  for (const Triangle& t : mesh.triangles) {
    bytes.push_back(3);
    for (const std::int32_t v : t) append(bytes, v, big_endian);
  }
  return bytes;
}

}  // namespace softscope::test
