// src/mesh/ply_header.h: header of a PLY file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

enum class PlyEncoding { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat, kDouble };

/// Bytes of one value in a binary file.
int sizeOf(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat;
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // of a list's length
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Position of the first property of that name, -1 if there is none.
  int find(std::string_view property) const;
  /// The fewest bytes that one such element takes.
  std::uint64_t leastBytes(PlyEncoding encoding) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::kAscii;
  std::vector<PlyElement> elements;
  std::size_t bytes = 0;  // where the data begin
  int lines = 0;
};

/// Throws InputError that begins with `name`; no element promises more than the file can hold.
PlyHeader parsePlyHeader(std::string_view bytes, const std::string& name);

}  // namespace softscope
