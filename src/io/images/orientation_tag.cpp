#include "io/images/orientation_tag.h"

#include <cstdint>
#include <string>

#include "core/error.h"
#include "io/files/file_bytes.h"

namespace softscope {
namespace {

constexpr int kAsStored = 1, kLastOrientation = 8;
constexpr std::string_view kExifStart{"Exif\0\0", 6};
constexpr std::uint32_t kOrientationField = 0x112;

/// Bytes in one byte order; 0 beyond the end.
class TagBytes {
 public:
  TagBytes(std::string_view bytes, bool little_endian) : bytes_(bytes), little_(little_endian) {}

  std::uint32_t read(std::size_t begin, std::size_t count) const {
    if (begin > bytes_.size() || count > bytes_.size() - begin) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t k = little_ ? count - 1 - i : i;
      value = value << 8 | static_cast<unsigned char>(bytes_[begin + k]);
    }
    return value;
  }

 private:
  std::string_view bytes_;
  bool little_;
};

/// `tiff`: content of the Exif segment, whose first directory has the tag.
int orientationIn(std::string_view tiff) {
  const TagBytes bytes(tiff, tiff.substr(0, 2) == "II");
  const std::size_t directory = bytes.read(4, 4);
  const std::uint32_t fields = bytes.read(directory, 2);
  for (std::uint32_t i = 0; i < fields; ++i) {
    const std::size_t field = directory + 2 + std::size_t{12} * i;
    if (field >= tiff.size()) break;
    if (bytes.read(field, 2) != kOrientationField) continue;
    const auto value = static_cast<int>(bytes.read(field + 8, 2));
    return value >= kAsStored && value <= kLastOrientation ? value : kAsStored;
  }
  return kAsStored;
}

}  // namespace

int parseOrientationTag(std::string_view bytes) {
  const TagBytes marks(bytes, false);
  if (marks.read(0, 2) != 0xffd8) return kAsStored;
  for (std::size_t at = 2; marks.read(at, 1) == 0xff && marks.read(at + 1, 1) != 0xda;) {
    const std::size_t length = marks.read(at + 2, 2);
    if (length < 2) break;
    const std::string_view content =
        bytes.substr(at + 4 < bytes.size() ? at + 4 : bytes.size(), length - 2);
    if (marks.read(at + 1, 1) == 0xe1 && content.substr(0, kExifStart.size()) == kExifStart)
      return orientationIn(content.substr(kExifStart.size()));
    at += 2 + length;
  }
  return kAsStored;
}

int orientationTag(const std::filesystem::path& file) {
  try {
    return parseOrientationTag(readBytes(file));
  } catch (const InputError&) {
    return kAsStored;
  }
}

}  // namespace softscope
