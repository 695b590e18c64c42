// toolkit/export/export_gltf.cpp: one buffer with four views, as in the specification.
#include "toolkit/export/export_gltf.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "mesh/mesh_writer.h"
#include "toolkit/record/version.h"
#include "vtk_views/drawing/html_text.h"

namespace softscope {
namespace {

using Json = nlohmann::ordered_json;

// Constants of the specification.
constexpr int kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;
constexpr int kVertexData = 34962, kIndexData = 34963;
constexpr int kPointMode = 0, kTriangleMode = 4;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A,
                        kBinaryChunk = 0x004E4942;
constexpr double kMetre_mm = 1000;

template <class Number>
void append(std::string& out, Number value) {  // little-endian, as all supported machines
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

/// Buffer with its descriptions.
struct Parts {
  std::string buffer;
  Json views = Json::array(), accessors = Json::array();

  /// Describes the data appended since `begin`; returns the index of the accessor.
  int describe(std::size_t begin, int target, int component, const char* type, std::size_t count) {
    views.push_back({{"buffer", 0},
                     {"byteOffset", begin},
                     {"byteLength", buffer.size() - begin},
                     {"target", target}});
    accessors.push_back({{"bufferView", views.size() - 1},
                         {"componentType", component},
                         {"count", count},
                         {"type", type}});
    return int(accessors.size()) - 1;
  }
};

int addVectors(const std::vector<Eigen::Vector3f>& vectors, Parts& parts) {
  const std::size_t begin = parts.buffer.size();
  for (const Eigen::Vector3f& vector : vectors)
    for (int axis = 0; axis < 3; ++axis) append(parts.buffer, vector[axis]);
  return parts.describe(begin, kVertexData, kFloat, "VEC3", vectors.size());
}

int addPositions(const std::vector<Eigen::Vector3f>& points_mm, Parts& parts) {
  std::vector<Eigen::Vector3f> points_m;
  points_m.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm)
    points_m.push_back((p.cast<double>() / kMetre_mm).cast<float>());
  const int accessor = addVectors(points_m, parts);
  Eigen::Vector3f low = points_m.at(0), high = points_m[0];
  for (const Eigen::Vector3f& p : points_m) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  parts.accessors[std::size_t(accessor)]["min"] = {low.x(), low.y(), low.z()};
  parts.accessors[std::size_t(accessor)]["max"] = {high.x(), high.y(), high.z()};
  return accessor;
}

/// Unit length is required: a zero normal becomes the direction to the viewer.
int addNormals(std::vector<Eigen::Vector3f> normals, Parts& parts) {
  for (Eigen::Vector3f& normal : normals)
    normal = normal.allFinite() && normal.norm() > 0.5f ? normal.normalized().eval()
                                                        : Eigen::Vector3f(0, 0, -1);
  return addVectors(normals, parts);
}

/// Images are in sRGB, glTF in linear light: 16 bits keep dark colours distinct.
std::array<std::uint16_t, 256> linearLight() {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double share = double(i) / 255;
    const double linear = share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    table[i] = std::uint16_t(std::lround(65535 * linear));
  }
  return table;
}

int addColours(const std::vector<Rgb8>& colours, Parts& parts) {
  const auto light = linearLight();
  const std::size_t begin = parts.buffer.size();
  for (const Rgb8& colour : colours) {
    for (const std::uint8_t channel : {colour.red, colour.green, colour.blue})
      append(parts.buffer, light[channel]);
    append(parts.buffer, std::uint16_t(65535));  // opaque; keeps each colour aligned to 4 bytes
  }
  const int accessor = parts.describe(begin, kVertexData, kUnsignedShort, "VEC4", colours.size());
  parts.accessors[std::size_t(accessor)]["normalized"] = true;
  return accessor;
}

int addIndices(const std::vector<Triangle>& triangles, Parts& parts) {
  const std::size_t begin = parts.buffer.size();
  for (const Triangle& t : triangles)
    for (const std::int32_t vertex : t) append(parts.buffer, std::uint32_t(vertex));
  return parts.describe(begin, kIndexData, kUnsignedInt, "SCALAR", 3 * triangles.size());
}

/// Quaternion x y z w of the rotation into the axes of glTF: y up, front towards +z.
Json uprightTurn(const ModelSurface& surface) {
  const double half = std::sqrt(0.5);
  if (!surface.frame.empty()) return {1, 0, 0, 0};        // y down, z away: half a turn about x
  if (surface.space == "RAS") return {0, half, half, 0};  // x right, y front, z up
  return {-half, 0, 0, half};                             // LPS: x left, y back, z up
}

Json assetOf(const ModelSurface& surface) {
  Json extras = {{"unit", "m"}};
  if (!surface.space.empty()) extras["SPACE"] = surface.space;
  if (!surface.frame.empty()) extras["frame"] = surface.frame;
  return {{"version", "2.0"}, {"generator", "softscope " + versionText()}, {"extras", extras}};
}

Json documentOf(const ModelSurface& surface, Parts& parts) {
  Json attributes = {{"POSITION", addPositions(surface.vertices.points_mm, parts)}};
  if (!surface.vertices.normals.empty())
    attributes["NORMAL"] = addNormals(surface.vertices.normals, parts);
  if (!surface.vertices.colours.empty())
    attributes["COLOR_0"] = addColours(surface.vertices.colours, parts);
  Json primitive = {{"attributes", attributes}, {"material", 0}};
  if (!surface.triangles.empty()) primitive["indices"] = addIndices(surface.triangles, parts);
  primitive["mode"] = surface.triangles.empty() ? kPointMode : kTriangleMode;
  const Json matt = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
  const Json material = {{"pbrMetallicRoughness", matt}, {"doubleSided", true}};
  const Json mesh = {{"name", "model"}, {"primitives", Json::array({primitive})}};
  const Json node = {{"name", "model"}, {"mesh", 0}, {"rotation", uprightTurn(surface)}};
  const Json scene = {{"nodes", Json::array({0})}};
  const Json buffer = {{"byteLength", parts.buffer.size()}};
  return {{"asset", assetOf(surface)},       {"scene", 0},
          {"scenes", Json::array({scene})},  {"nodes", Json::array({node})},
          {"meshes", Json::array({mesh})},   {"materials", Json::array({material})},
          {"accessors", parts.accessors},    {"bufferViews", parts.views},
          {"buffers", Json::array({buffer})}};
}

void appendChunk(std::string& out, std::uint32_t kind, std::string content, char filler) {
  content.resize((content.size() + 3) / 4 * 4, filler);
  append(out, std::uint32_t(content.size()));
  append(out, kind);
  out += content;
}

}  // namespace

std::string glbFile(const ModelSurface& surface) {
  requireConsistent(surface);
  Parts parts;
  const std::string json = documentOf(surface, parts).dump();
  std::string chunks;
  appendChunk(chunks, kJsonChunk, json, ' ');
  appendChunk(chunks, kBinaryChunk, std::move(parts.buffer), '\0');
  std::string out;
  append(out, kMagic);
  append(out, kVersion);
  append(out, std::uint32_t(chunks.size() + 12));
  return out + chunks;
}

std::string gltfFile(const ModelSurface& surface) {
  requireConsistent(surface);
  Parts parts;
  Json json = documentOf(surface, parts);
  json["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(parts.buffer);
  return json.dump(1) + "\n";
}

}  // namespace softscope
