#include "tests/vtk_views/dicom_tags.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

namespace softscope::test {

void replaceDicomTag(const std::filesystem::path& file, unsigned group, unsigned element,
                     const char* value) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  in.close();
  const std::string tag{char(group & 255), char(group >> 8), char(element & 255),
                        char(element >> 8)};
  const auto at = bytes.find(tag, 132);
  ASSERT_NE(at, std::string::npos) << file;
  const auto byte = [&](std::size_t i) {
    return std::size_t(static_cast<unsigned char>(bytes[i]));
  };
  const std::size_t length = byte(at + 6) + 256 * byte(at + 7);  // after the VR's two letters
  std::string element_bytes;
  if (value != nullptr) {
    std::string text = value;
    if (text.size() % 2 == 1) text += ' ';
    element_bytes =
        tag + bytes.substr(at + 4, 2) + char(text.size() & 255) + char(text.size() >> 8) + text;
  }
  bytes.replace(at, 8 + length, element_bytes);
  std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace softscope::test
