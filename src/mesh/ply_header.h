// src/mesh/ply_header.h: header of a PLY file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// Size of one value in a binary file.
int sizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of the length of a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of the first property of that name, -1 if absent.
  int find(std::string_view property) const;
  /// Minimum size of one element.
  std::uint64_t leastBytes(PlyEncoding encoding) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // offset of the data
  int lines = 0;
};

/// Throws InputError that begins with `name`; element counts are limited by the size of the file.
PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name);

}  // namespace softscope
