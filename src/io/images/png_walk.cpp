// src/io/images/png_walk.cpp: chunks of a PNG with their checksums.
#include <array>

#include "io/files/byte_cursor.h"
#include "io/images/image_walks.h"

namespace softscope {
namespace {

using CrcTable = std::array<std::uint32_t, 256>;

/// Checksum of ISO 3309 (PNG specification, annex D).
CrcTable makeCrcTable() {
  CrcTable table{};
  for (std::uint32_t n = 0; n < 256; ++n) {
    std::uint32_t c = n;
    for (int bit = 0; bit < 8; ++bit) c = (c & 1) ? 0xEDB88320U ^ (c >> 1) : c >> 1;
    table[n] = c;
  }
  return table;
}

std::uint32_t checkSum(std::string_view bytes) {
  static const CrcTable table = makeCrcTable();
  std::uint32_t c = 0xFFFFFFFFU;
  for (const char byte : bytes) c = table[(c ^ static_cast<std::uint8_t>(byte)) & 0xFF] ^ (c >> 8);
  return c ^ 0xFFFFFFFFU;
}

}  // namespace

PictureSize walkPng(std::string_view bytes, const std::string& name) {
  ByteCursor cursor(bytes, name, /*big_endian=*/true);
  cursor.moveTo(kPngSignature.size());
  PictureSize size;
  bool has_data = false;
  while (true) {
    const std::size_t length = cursor.u32();
    const std::size_t begin = cursor.position();
    const std::string_view type = cursor.take(4);
    cursor.take(length);
    const std::uint32_t stored = cursor.u32();
    if (checkSum(bytes.substr(begin, 4 + length)) != stored) cursor.failDamaged("check sum");
    if ((begin == kPngSignature.size() + 4) != (type == "IHDR"))
      cursor.failDamaged("order of parts");
    if (type == "IHDR") {
      ByteCursor header(bytes.substr(begin + 4, length), name, true);
      size.width_px = header.u32();
      size.height_px = header.u32();
    }
    has_data = has_data || type == "IDAT";
    if (type == "IEND") break;
  }
  if (!has_data) cursor.failDamaged("no image data");
  return size;
}

}  // namespace softscope
