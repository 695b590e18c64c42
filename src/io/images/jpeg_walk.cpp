// src/io/images/jpeg_walk.cpp: markers of a JPEG up to its end.
#include "io/files/byte_cursor.h"
#include "io/images/image_walks.h"

namespace softscope {
namespace {

constexpr std::uint8_t kEndOfImage = 0xD9, kStartOfScan = 0xDA;

bool standsAlone(std::uint8_t marker) {  // has no length field
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD7);
}
bool isFrameHeader(std::uint8_t marker) {  // SOF0 to SOF15, without DHT, JPG and DAC
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

std::uint8_t nextMarker(ByteCursor& cursor) {
  if (cursor.u8() != 0xFF) cursor.failDamaged("a marker is missing");
  std::uint8_t marker = 0xFF;
  while (marker == 0xFF) marker = cursor.u8();  // fill bytes
  return marker;
}

/// Moves to the marker after the coded data; FF00 is a data byte, FFD0 to FFD7 are restarts.
void skipScan(ByteCursor& cursor, std::string_view bytes) {
  std::size_t at = cursor.position();
  while (true) {
    at = bytes.find('\xFF', at);
    if (at == std::string_view::npos || at + 1 >= bytes.size()) cursor.failTruncated();
    const auto next = static_cast<std::uint8_t>(bytes[at + 1]);
    const bool is_data = next == 0x00 || (next >= 0xD0 && next <= 0xD7);
    if (!is_data && next != 0xFF) break;
    at += is_data ? 2 : 1;
  }
  cursor.moveTo(at);
}

}  // namespace

PictureSize walkJpeg(std::string_view bytes, const std::string& name) {
  ByteCursor cursor(bytes, name, /*big_endian=*/true);
  cursor.moveTo(2);  // start of image
  PictureSize size;
  bool has_scan = false;
  for (std::uint8_t marker = nextMarker(cursor); marker != kEndOfImage;
       marker = nextMarker(cursor)) {
    if (standsAlone(marker)) continue;
    const std::size_t begin = cursor.position();
    const std::size_t length = cursor.u16();
    if (length < 2) cursor.failDamaged("length of a part");
    if (isFrameHeader(marker)) {
      cursor.u8();  // bits per sample
      size.height_px = cursor.u16();
      size.width_px = cursor.u16();
    }
    cursor.moveTo(begin + length);
    if (marker != kStartOfScan) continue;
    has_scan = true;
    skipScan(cursor, bytes);
  }
  if (!has_scan) cursor.failDamaged("no image data");
  return size;
}

}  // namespace softscope
