// src/io/images/simple_walks.cpp: BMP, TIFF and
// PGM/PPM, with size and length in their first bytes.
#include <cstdlib>

#include "io/files/byte_cursor.h"
#include "io/images/image_walks.h"
#include "io/images/picture_limits.h"

namespace softscope {
namespace {

void requireBytes(const ByteCursor& cursor, long begin, long bytes_per_row, long rows) {
  const long available = static_cast<long>(cursor.position() + cursor.left());
  if (begin > available || rows * bytes_per_row > available - begin) cursor.failTruncated();
}

/// Number of a PNM header, after blanks and comments.
long pnmNumber(ByteCursor& cursor) {
  char c = static_cast<char>(cursor.u8());
  while (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '#') {
    if (c == '#')
      while (cursor.u8() != '\n') {
      }
    c = static_cast<char>(cursor.u8());
  }
  long value = 0;
  for (int digits = 0; c >= '0' && c <= '9'; c = static_cast<char>(cursor.u8())) {
    value = 10 * value + (c - '0');
    if (++digits > 9) cursor.failDamaged("size");
  }
  if (c != ' ' && c != '\t' && c != '\r' && c != '\n') cursor.failDamaged("header");
  return value;
}

}  // namespace

PictureSize walkBmp(std::string_view bytes, const std::string& name) {
  ByteCursor cursor(bytes, name, /*big_endian=*/false);
  cursor.moveTo(10);
  const long begin = cursor.u32();
  if (cursor.u32() < 40) cursor.failDamaged("header of an old form");
  const long width = cursor.i32(), height = std::labs(static_cast<long>(cursor.i32()));
  cursor.u16();  // planes
  const long bits = cursor.u16();
  const bool is_plain = cursor.u32() == 0;
  requirePictureSize(width, height, name);
  if (is_plain) requireBytes(cursor, begin, (width * bits + 31) / 32 * 4, height);
  return {width, height};
}

PictureSize walkTiff(std::string_view bytes, const std::string& name) {
  constexpr std::uint16_t kWidthTag = 256, kHeightTag = 257, kShortType = 3, kLongType = 4;
  ByteCursor cursor(bytes, name, /*big_endian=*/bytes.front() == 'M');
  cursor.moveTo(4);
  cursor.moveTo(cursor.u32());
  PictureSize size;
  for (int entries = cursor.u16(); entries > 0; --entries) {
    const std::uint16_t tag = cursor.u16(), type = cursor.u16();
    const std::uint32_t count = cursor.u32();
    const std::size_t value_at = cursor.position();
    if ((tag == kWidthTag || tag == kHeightTag) && count == 1 &&
        (type == kShortType || type == kLongType)) {
      const long value = type == kShortType ? cursor.u16() : cursor.u32();
      (tag == kWidthTag ? size.width_px : size.height_px) = value;
    }
    cursor.moveTo(value_at + 4);
  }
  return size;
}

PictureSize walkPnm(std::string_view bytes, const std::string& name) {
  ByteCursor cursor(bytes, name, /*big_endian=*/true);
  const bool is_colour = cursor.take(2)[1] == '6';
  const long width = pnmNumber(cursor), height = pnmNumber(cursor), most = pnmNumber(cursor);
  if (most < 1 || most > 65535) cursor.failDamaged("largest value");
  requirePictureSize(width, height, name);
  const long bytes_per_pixel = (is_colour ? 3 : 1) * (most > 255 ? 2 : 1);
  requireBytes(cursor, static_cast<long>(cursor.position()), width * bytes_per_pixel, height);
  return {width, height};
}

}  // namespace softscope
