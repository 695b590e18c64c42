// src/mesh/ply_format.cpp: PLY, ascii and binary: vertices, their colours, faces.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "mesh/mesh_formats.h"
#include "mesh/ply_header.h"
#include "mesh/text_scanner.h"

namespace softscope {
namespace {

/// Values after the header in sequence, as double: exact for every type of PLY.
class PlyValues {
 public:
  /// Keeps a reference to `name`.
  PlyValues(std::string_view bytes, const PlyHeader& header, const std::string& name)
      : bytes_(bytes.substr(header.bytes)),
        encoding_(header.encoding),
        text_(bytes_, name, header.lines + 1),
        name_(name) {}

  double next(PlyType type) {
    if (encoding_ == PlyEncoding::kAscii) return text_.number();
    const int size = sizeOf(type);
    if (at_ + static_cast<std::size_t>(size) > bytes_.size()) failTruncated();
    std::uint64_t bits = 0;
    for (int i = 0; i < size; ++i) {
      const int from = encoding_ == PlyEncoding::kBigEndian ? i : size - 1 - i;
      bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + static_cast<std::size_t>(from)]);
    }
    at_ += static_cast<std::size_t>(size);
    return toDouble(bits, type);
  }

  /// Length of a list, limited by the size of the file.
  std::size_t nextCount(const PlyProperty& list) {
    const double count = next(list.count_type);
    const std::size_t left =
        bytes_.size() - (encoding_ == PlyEncoding::kAscii ? text_.position() : at_);
    if (!(count >= 0) || count != std::floor(count)) fail("a list has no whole length");
    if (count > static_cast<double>(left)) failTruncated();
    return static_cast<std::size_t>(count);
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(name_ + ": " + what + "; export the mesh again");
  }

 private:
  [[noreturn]] void failTruncated() const { fail("the data end early: the file is truncated"); }

  template <class Value>
  static double as(std::uint64_t bits) {
    Value value;
    std::memcpy(&value, &bits, sizeof value);  // the low bytes, on little-endian machines
    return static_cast<double>(value);
  }

  static double toDouble(std::uint64_t bits, PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return as<std::int8_t>(bits);
      case PlyType::kUint8:
        return as<std::uint8_t>(bits);
      case PlyType::kInt16:
        return as<std::int16_t>(bits);
      case PlyType::kUint16:
        return as<std::uint16_t>(bits);
      case PlyType::kInt32:
        return as<std::int32_t>(bits);
      case PlyType::kUint32:
        return as<std::uint32_t>(bits);
      case PlyType::kFloat:
        return as<float>(bits);
      case PlyType::kDouble:
        return as<double>(bits);
    }
    return 0;
  }

  std::string_view bytes_;
  PlyEncoding encoding_;
  TextScanner text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

/// Reads one element; scalars at the index of their property.
void readScalars(PlyValues& values, const PlyElement& element, std::vector<double>& scalars) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (!property.is_list) {
      scalars[i] = values.next(property.type);
      continue;
    }
    for (std::size_t n = values.nextCount(property); n > 0; --n) values.next(property.type);
  }
}

std::uint8_t colourByte(double value, PlyType type) {
  const bool share = type == PlyType::kFloat || type == PlyType::kDouble;
  const double scaled = std::round(share ? value * 255 : value);
  return static_cast<std::uint8_t>(scaled > 0 ? std::min(scaled, 255.0) : 0);
}

void readVertices(PlyValues& values, const PlyElement& element, TriangleMesh& mesh) {
  const int place[3] = {element.find("x"), element.find("y"), element.find("z")};
  const int colour[3] = {element.find("red"), element.find("green"), element.find("blue")};
  for (const int i : place)
    if (i < 0 || element.properties[i].is_list) values.fail("the vertices have no x, y, z");
  const bool coloured = colour[0] >= 0 && colour[1] >= 0 && colour[2] >= 0;
  std::vector<double> scalars(element.properties.size());
  const auto byte = [&](int i) {
    return colourByte(scalars[colour[i]], element.properties[colour[i]].type);
  };
  for (std::uint64_t n = 0; n < element.count; ++n) {
    readScalars(values, element, scalars);
    mesh.vertices_mm.emplace_back(static_cast<float>(scalars[place[0]]),
                                  static_cast<float>(scalars[place[1]]),
                                  static_cast<float>(scalars[place[2]]));
    if (coloured) mesh.colours.push_back({byte(0), byte(1), byte(2)});
  }
}

/// Index, or -1 if it is invalid; readMesh reports it.
std::int32_t toIndex(double value) {
  return value >= 0 && value <= INT32_MAX ? static_cast<std::int32_t>(value) : -1;
}

void readFaces(PlyValues& values, const PlyElement& element, TriangleMesh& mesh) {
  const int found = element.find("vertex_indices");
  const int corners_at = found >= 0 ? found : element.find("vertex_index");
  if (corners_at < 0 || !element.properties[corners_at].is_list)
    values.fail("the faces have no list vertex_indices");
  std::vector<std::int32_t> corners;
  for (std::uint64_t n = 0; n < element.count; ++n)
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const PlyProperty& property = element.properties[i];
      const std::size_t count = property.is_list ? values.nextCount(property) : 1;
      corners.clear();
      for (std::size_t k = 0; k < count; ++k)
        corners.push_back(toIndex(values.next(property.type)));
      if (i == corners_at) addPolygon(corners, mesh.triangles);
    }
}

}  // namespace

ParsedMesh parsePly(std::string_view bytes, const std::string& name) {
  const PlyHeader header = parsePlyHeader(bytes, name);
  ParsedMesh parsed;
  parsed.comments = bytes.substr(0, header.bytes);
  PlyValues values(bytes, header, name);
  for (const PlyElement& element : header.elements) {
    if (element.properties.empty()) continue;  // has no bytes
    std::vector<double> scalars(element.properties.size());
    if (element.name == "vertex")
      readVertices(values, element, parsed.mesh);
    else if (element.name == "face")
      readFaces(values, element, parsed.mesh);
    else
      for (std::uint64_t n = 0; n < element.count; ++n) readScalars(values, element, scalars);
  }
  if (parsed.mesh.colours.size() != parsed.mesh.vertices_mm.size()) parsed.mesh.colours.clear();
  return parsed;
}

}  // namespace softscope
