#include "io/images/orientation_tag.h"

#include <cstdint>
#include <string>

#include "core/error.h"
#include "io/files/byte_cursor.h"
#include "io/files/file_bytes.h"

namespace softscope {
namespace {

constexpr int kAsStored = 1, kLastOrientation = 8;
constexpr std::string_view kExifStart{"Exif\0\0", 6};
constexpr std::uint16_t kFirstMarker = 0xffd8, kOrientationField = 0x112;
constexpr std::uint8_t kExifSegment = 0xe1, kFirstScan = 0xda;
constexpr std::size_t kFieldBytes = 12, kValueAt = 8;

/// `tiff`: content of the Exif segment, whose first directory has the tag.
int orientationIn(std::string_view tiff) {
  ByteCursor cursor(tiff, "", /*big_endian=*/tiff.substr(0, 2) != "II");
  cursor.moveTo(4);
  cursor.moveTo(cursor.u32());
  for (int fields = cursor.u16(); fields > 0; --fields) {
    const std::size_t field = cursor.position();
    if (cursor.u16() != kOrientationField) {
      cursor.moveTo(field + kFieldBytes);
      continue;
    }
    cursor.moveTo(field + kValueAt);
    const int value = cursor.u16();
    return value >= kAsStored && value <= kLastOrientation ? value : kAsStored;
  }
  return kAsStored;
}

/// Throws InputError where the bytes end early.
int orientationOfJpeg(std::string_view bytes) {
  ByteCursor cursor(bytes, "", /*big_endian=*/true);
  if (cursor.u16() != kFirstMarker) return kAsStored;
  while (cursor.u8() == 0xff) {
    const std::uint8_t marker = cursor.u8();
    if (marker == kFirstScan) break;
    const std::size_t begin = cursor.position();
    const std::size_t length = cursor.u16();
    if (length < 2) break;
    const std::string_view content = bytes.substr(cursor.position(), length - 2);
    if (marker == kExifSegment && content.substr(0, kExifStart.size()) == kExifStart)
      return orientationIn(content.substr(kExifStart.size()));
    cursor.moveTo(begin + length);
  }
  return kAsStored;
}

}  // namespace

int parseOrientationTag(std::string_view bytes) {
  try {
    return orientationOfJpeg(bytes);
  } catch (const InputError&) {
    return kAsStored;
  }
}

int orientationTag(const std::filesystem::path& file) {
  try {
    return parseOrientationTag(readBytes(file));
  } catch (const InputError&) {
    return kAsStored;
  }
}

}  // namespace softscope
