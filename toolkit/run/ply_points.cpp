// toolkit/run/ply_points.cpp: header parsed by src/mesh, coordinates read from the bytes.
#include "toolkit/run/ply_points.h"

#include <algorithm>
#include <cstring>
#include <sstream>

#include "core/error.h"
#include "io/text/text_lines.h"
#include "mesh/ply_header.h"

namespace softscope {
namespace {

const PlyElement* elementNamed(const PlyHeader& header, const char* name) {
  for (const PlyElement& element : header.elements)
    if (element.name == name) return &element;
  return nullptr;
}

/// One coordinate of a binary point.
double valueAt(const char* bytes, PlyType type, bool little_endian, const std::string& name) {
  char ordered[8];
  const auto size = std::size_t(sizeOf(type));
  std::memcpy(ordered, bytes, size);
  if (!little_endian) std::reverse(ordered, ordered + size);
  if (type == PlyType::kFloat) {
    float value = 0;
    std::memcpy(&value, ordered, sizeof value);
    return value;
  }
  if (type != PlyType::kDouble) throw InputError(name + ": x, y, z must be float or double");
  double value = 0;
  std::memcpy(&value, ordered, sizeof value);
  return value;
}

constexpr double kFarthestPointMm = 1e7;  // the same limit as for surfaces

void add(const Eigen::Vector3d& point, PlyPoints& points) {
  if (point.allFinite() && point.cwiseAbs().maxCoeff() <= kFarthestPointMm)
    points.box_mm.extend(point);
  else
    ++points.invalid;
}

void readBinary(std::string_view bytes, const PlyHeader& header, const PlyElement& vertex,
                const std::string& name, PlyPoints& points) {
  std::size_t stride = 0;
  std::array<std::size_t, 3> offsets{};
  std::array<PlyType, 3> types{};
  const std::array<const char*, 3> axes{"x", "y", "z"};
  for (const PlyProperty& property : vertex.properties) {
    if (property.is_list) throw InputError(name + ": points with lists are not read");
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (property.name == axes[axis]) {
        offsets[axis] = stride;
        types[axis] = property.type;
      }
    stride += std::size_t(sizeOf(property.type));
  }
  const std::string_view data = bytes.substr(header.bytes);
  if (data.size() / stride < vertex.count)
    throw InputError(name + ": is truncated: " + std::to_string(vertex.count) +
                     " points are announced, " + std::to_string(data.size() / stride) +
                     " found. Copy it again");
  const bool little = header.encoding == PlyEncoding::kLittleEndian;
  for (std::size_t i = 0; i < vertex.count; ++i) {
    Eigen::Vector3d point;
    for (std::size_t axis = 0; axis < 3; ++axis)
      point[Eigen::Index(axis)] =
          valueAt(data.data() + i * stride + offsets[axis], types[axis], little, name);
    add(point, points);
  }
}

void readAscii(std::string_view bytes, const PlyHeader& header, const PlyElement& vertex,
               const std::string& name, PlyPoints& points) {
  const auto lines = linesOf(bytes.substr(header.bytes));
  const std::array<int, 3> columns{vertex.find("x"), vertex.find("y"), vertex.find("z")};
  for (std::size_t i = 0; i < vertex.count; ++i) {
    const auto words = i < lines.size() ? wordsOf(lines[i]) : std::vector<std::string_view>();
    if (words.size() < vertex.properties.size())
      throw InputError(name + ": point " + std::to_string(i) + " is truncated. Copy it again");
    Eigen::Vector3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = numberOf(words[std::size_t(columns[std::size_t(axis)])]).value_or(NAN);
    add(point, points);
  }
}

std::vector<std::string> commentsOf(std::string_view header) {
  std::vector<std::string> comments;
  for (const std::string_view line : linesOf(header))
    if (line.rfind("comment ", 0) == 0) comments.emplace_back(trimmed(line.substr(8)));
  return comments;
}

}  // namespace

bool isPlyOfPoints(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 3) != "ply") return false;
  const PlyHeader header = parsePlyHeader(bytes, name);
  const PlyElement* faces = elementNamed(header, "face");
  return faces == nullptr || faces->count == 0;
}

PlyPoints describePlyPoints(std::string_view bytes, const std::string& name) {
  const PlyHeader header = parsePlyHeader(bytes, name);
  const PlyElement* vertex = elementNamed(header, "vertex");
  if (vertex == nullptr || vertex != &header.elements.front() || vertex->find("x") < 0 ||
      vertex->find("y") < 0 || vertex->find("z") < 0)
    throw InputError(name + ": must begin with vertices that have x, y and z");
  PlyPoints points;
  points.count = vertex->count;
  points.comments = commentsOf(bytes.substr(0, header.bytes));
  for (const PlyProperty& property : vertex->properties) points.properties.push_back(property.name);
  if (header.encoding == PlyEncoding::kAscii)
    readAscii(bytes, header, *vertex, name, points);
  else
    readBinary(bytes, header, *vertex, name, points);
  return points;
}

}  // namespace softscope
