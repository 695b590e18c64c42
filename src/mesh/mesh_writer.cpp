// src/mesh/mesh_writer.cpp: PLY, OBJ and STL, byte by byte.
#include "mesh/mesh_writer.h"

#include <Eigen/Geometry>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "core/error.h"

namespace softscope {
namespace {

void requireOneEach(std::size_t count, const ModelSurface& surface, const char* what) {
  const std::size_t vertices = surface.vertices.points_mm.size();
  if (count == 0 || count == vertices) return;
  throw Error("a surface has " + std::to_string(count) + " " + what + ", but " +
              std::to_string(vertices) + " vertices; one a vertex, or none, is expected");
}

void requireTriangles(const ModelSurface& surface, const char* format) {
  if (surface.triangles.empty())
    throw Error(std::string(format) + " holds triangles, but there are only points");
}

void append(std::string& out, std::uint32_t bits) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(bits >> (8 * i) & 0xFF);
}

void append(std::string& out, float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, 4);
  append(out, bits);
}

void append(std::string& out, const Eigen::Vector3f& vector) {
  for (int axis = 0; axis < 3; ++axis) append(out, vector[axis]);
}

Eigen::Vector3f inUnit(const Eigen::Vector3f& point_mm, const LengthUnit& unit) {
  return (point_mm.cast<double>() / unit.mm).cast<float>();
}

Eigen::Vector3f finite(const Eigen::Vector3f& normal) {
  return normal.allFinite() ? normal : Eigen::Vector3f(0, 0, 0);
}

/// The header lines about the coordinates; each begins with `prefix`.
std::string remarks(const ModelSurface& surface, const LengthUnit& unit, const char* prefix) {
  std::string text = prefix + ("unit " + unit.name) + "\n";
  if (!surface.frame.empty()) text += prefix + ("frame " + surface.frame) + "\n";
  if (!surface.space.empty()) text += prefix + ("SPACE=" + surface.space) + "\n";
  return text;
}

std::string plyHeader(const ModelSurface& surface, const LengthUnit& unit) {
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  out += remarks(surface, unit, "comment ");
  out += "element vertex " + std::to_string(surface.vertices.points_mm.size());
  out += "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!surface.vertices.normals.empty())
    out += "property float nx\nproperty float ny\nproperty float nz\n";
  if (!surface.vertices.colours.empty())
    out += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  if (!surface.vertices.weights.empty()) out += "property float weight\n";
  if (!surface.vertices.sigmas_mm.empty()) out += "property float sigma_mm\n";
  if (!surface.triangles.empty())
    out += "element face " + std::to_string(surface.triangles.size()) +
           "\nproperty list uchar int vertex_indices\n";
  return out + "end_header\n";
}

Eigen::Vector3f faceNormal(const std::vector<Eigen::Vector3f>& points, const Triangle& t) {
  const Eigen::Vector3d a = points[std::size_t(t[0])].cast<double>();
  const Eigen::Vector3d b = points[std::size_t(t[1])].cast<double>();
  const Eigen::Vector3d c = points[std::size_t(t[2])].cast<double>();
  return (b - a).cross(c - a).normalized().cast<float>();
}

template <class... Numbers>
void appendText(std::string& out, const char* form, Numbers... numbers) {
  char text[160];
  const int length = std::snprintf(text, sizeof text, form, numbers...);
  out.append(text, std::size_t(length));
}

}  // namespace

void requireConsistent(const ModelSurface& surface) {
  requireOneEach(surface.vertices.normals.size(), surface, "normals");
  requireOneEach(surface.vertices.colours.size(), surface, "colours");
  requireOneEach(surface.vertices.weights.size(), surface, "weights");
  requireOneEach(surface.vertices.sigmas_mm.size(), surface, "sigmas");
  const auto count = std::int64_t(surface.vertices.points_mm.size());
  for (const Triangle& t : surface.triangles)
    for (const std::int32_t vertex : t)
      if (vertex < 0 || vertex >= count)
        throw Error("a triangle names vertex " + std::to_string(vertex) + ", but there are " +
                    std::to_string(count) + ", counted from 0");
}

std::string plyFile(const ModelSurface& surface, const LengthUnit& unit) {
  requireConsistent(surface);
  const PointCloud& vertices = surface.vertices;
  std::string out = plyHeader(surface, unit);
  out.reserve(out.size() + 35 * vertices.points_mm.size() + 13 * surface.triangles.size());
  for (std::size_t i = 0; i < vertices.points_mm.size(); ++i) {
    append(out, inUnit(vertices.points_mm[i], unit));
    if (!vertices.normals.empty()) append(out, finite(vertices.normals[i]));
    if (!vertices.colours.empty())
      for (const std::uint8_t channel :
           {vertices.colours[i].red, vertices.colours[i].green, vertices.colours[i].blue})
        out += static_cast<char>(channel);
    if (!vertices.weights.empty()) append(out, vertices.weights[i]);
    if (!vertices.sigmas_mm.empty()) append(out, vertices.sigmas_mm[i]);
  }
  for (const Triangle& t : surface.triangles) {
    out += static_cast<char>(3);
    for (const std::int32_t vertex : t) append(out, static_cast<std::uint32_t>(vertex));
  }
  return out;
}

std::string objFile(const ModelSurface& surface, const LengthUnit& unit) {
  requireConsistent(surface);
  requireTriangles(surface, "OBJ");
  const PointCloud& vertices = surface.vertices;
  std::string out = remarks(surface, unit, "# ");
  for (std::size_t i = 0; i < vertices.points_mm.size(); ++i) {
    const Eigen::Vector3d p = inUnit(vertices.points_mm[i], unit).cast<double>();
    appendText(out, "v %.9g %.9g %.9g", p.x(), p.y(), p.z());
    if (!vertices.colours.empty())
      appendText(out, " %.4f %.4f %.4f", vertices.colours[i].red / 255.0,
                 vertices.colours[i].green / 255.0, vertices.colours[i].blue / 255.0);
    out += '\n';
  }
  for (const Eigen::Vector3f& normal : vertices.normals) {
    const Eigen::Vector3d n = finite(normal).cast<double>();
    appendText(out, "vn %.6f %.6f %.6f\n", n.x(), n.y(), n.z());
  }
  const bool with_normals = !vertices.normals.empty();
  for (const Triangle& t : surface.triangles)
    if (with_normals)
      appendText(out, "f %d//%d %d//%d %d//%d\n", t[0] + 1, t[0] + 1, t[1] + 1, t[1] + 1, t[2] + 1,
                 t[2] + 1);
    else
      appendText(out, "f %d %d %d\n", t[0] + 1, t[1] + 1, t[2] + 1);
  return out;
}

std::string stlFile(const ModelSurface& surface, const LengthUnit& unit) {
  constexpr std::size_t kHeaderBytes = 80;
  requireConsistent(surface);
  requireTriangles(surface, "STL");
  std::string out = "softscope " + remarks(surface, unit, "");  // must not begin with "solid"
  for (char& c : out)
    if (c == '\n') c = ' ';
  out.resize(kHeaderBytes, ' ');
  append(out, static_cast<std::uint32_t>(surface.triangles.size()));
  out.reserve(out.size() + 50 * surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    append(out, faceNormal(surface.vertices.points_mm, t));
    for (const std::int32_t vertex : t)
      append(out, inUnit(surface.vertices.points_mm[std::size_t(vertex)], unit));
    out.append(2, '\0');
  }
  return out;
}

}  // namespace softscope
