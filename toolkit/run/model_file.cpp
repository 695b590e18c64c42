// toolkit/run/model_file.cpp: header by src/mesh, values copied straight from the bytes.
#include "toolkit/run/model_file.h"

#include <array>
#include <cstring>
#include <optional>

#include "core/error.h"
#include "core/farthest.h"
#include "io/files/file_bytes.h"
#include "io/text/message.h"
#include "mesh/ply_header.h"

namespace softscope {
namespace {

const PlyElement& verticesOf(const PlyHeader& header, const std::string& name) {
  if (header.encoding != PlyEncoding::kLittleEndian)
    throw InputError(name +
                     ": points are read from a binary little-endian PLY, as softscope reconstruct "
                     "writes it, but this one is of another kind and has no triangles; convert it");
  if (header.elements.empty() || header.elements[0].name != "vertex")
    throw InputError(name + ": the first element is no vertex; give a model of points");
  for (const PlyProperty& property : header.elements[0].properties)
    if (property.is_list) throw InputError(name + ": points with lists are no model");
  return header.elements[0];
}

using Names = std::array<const char*, 3>;

std::size_t offsetOf(const PlyElement& vertices, int property) {
  std::size_t offset = 0;
  for (int i = 0; i < property; ++i)
    offset +=
        static_cast<std::size_t>(sizeOf(vertices.properties[static_cast<std::size_t>(i)].type));
  return offset;
}

/// Where a float stands, in bytes from the point's first.
std::optional<std::size_t> findFloat(const PlyElement& vertices, const char* name) {
  const int place = vertices.find(name);
  if (place < 0 || vertices.properties[static_cast<std::size_t>(place)].type != PlyType::kFloat)
    return {};
  return offsetOf(vertices, place);
}

/// Where three values of one type stand one after the other, in bytes from the point's first.
std::optional<std::size_t> findTriple(const PlyElement& vertices, const Names& names,
                                      PlyType type) {
  const int first = vertices.find(names[0]);
  if (first < 0 || static_cast<std::size_t>(first) + 3 > vertices.properties.size()) return {};
  for (std::size_t i = 0; i < 3; ++i) {
    const PlyProperty& property = vertices.properties[static_cast<std::size_t>(first) + i];
    if (property.name != names[i] || property.type != type) return {};
  }
  return offsetOf(vertices, first);
}

void requirePlausible(const Eigen::Vector3f& point_mm, std::size_t index, const std::string& name) {
  if (point_mm.cwiseAbs().maxCoeff() <= kFarthestMm && point_mm.allFinite()) return;
  throw InputError(say(name, ": point ", index, " is ", point_mm.x(), " ", point_mm.y(), " ",
                       point_mm.z(),
                       ", but a model has finite coordinates within 1 km, in mm; is the file "
                       "damaged?"));
}

}  // namespace

ModelFile parseModel(std::string_view bytes, const std::string& name, double unit_mm) {
  if (bytes.substr(0, 4) != "ply\n" && bytes.substr(0, 4) != "ply\r")
    throw InputError(name + ": is no PLY file; give a model that softscope reconstruct wrote");
  const PlyHeader header = parsePlyHeader(bytes, name);  // promises no more than there is
  const PlyElement& vertices = verticesOf(header, name);
  const auto position = findTriple(vertices, {"x", "y", "z"}, PlyType::kFloat);
  const auto normal = findTriple(vertices, {"nx", "ny", "nz"}, PlyType::kFloat);
  const auto colour = findTriple(vertices, {"red", "green", "blue"}, PlyType::kUint8);
  const auto weight = findFloat(vertices, "weight");
  const auto sigma = findFloat(vertices, "sigma_mm");
  if (!position)
    throw InputError(name +
                     ": its points have no consecutive floats x, y, z; give a model that softscope "
                     "reconstruct wrote");
  if (vertices.count == 0)
    throw InputError(name + ": contains no points; was the run lost from its first frame on?");
  ModelFile file;
  file.coloured = colour.has_value();
  file.with_normals = normal.has_value();
  file.weighted = weight.has_value();
  PointModel& model = file.model;
  model.reserve(vertices.count);
  if (sigma) file.sigmas_mm.resize(vertices.count);
  const char* at = bytes.data() + header.bytes;
  for (std::size_t i = 0; i < vertices.count; ++i, at += vertices.leastBytes(header.encoding)) {
    Eigen::Vector3f point_mm, direction = Eigen::Vector3f::Zero();
    Rgb8 looks;
    float sureness = 0;
    std::memcpy(point_mm.data(), at + *position, 3 * sizeof(float));
    requirePlausible(point_mm, i, name);
    if (normal) std::memcpy(direction.data(), at + *normal, 3 * sizeof(float));
    if (colour) std::memcpy(&looks, at + *colour, 3);
    if (weight) std::memcpy(&sureness, at + *weight, sizeof(float));
    if (sigma) std::memcpy(&file.sigmas_mm[i], at + *sigma, sizeof(float));
    model.add(point_mm, direction, looks, sureness);
  }
  file.unit_mm = unitOfFileMm(unit_mm, bytes.substr(0, header.bytes));
  toMillimetres(file.unit_mm, &model.positions_mm);
  return file;
}

ModelFile readModel(const std::filesystem::path& file) {
  return parseModel(readBytes(file), shown(file));
}

}  // namespace softscope
