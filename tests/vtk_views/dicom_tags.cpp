#include "tests/vtk_views/dicom_tags.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace softscope::test {
namespace {

std::string little(std::size_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += char(value >> (8 * i) & 255);
  return text;
}

/// One element of explicit VR, little endian.
std::string element(unsigned group, unsigned number, const std::string& vr, std::string value) {
  if (value.size() % 2 == 1) value += vr == "UI" ? '\0' : ' ';
  const bool long_form = vr == "SQ" || vr == "OW" || vr == "OB";
  return little(group, 2) + little(number, 2) + vr +
         (long_form ? little(0, 2) + little(value.size(), 4) : little(value.size(), 2)) + value;
}

std::string sequence(unsigned group, unsigned number, const std::vector<std::string>& items) {
  std::string all;
  for (const std::string& item : items)
    all += little(0xfffe, 2) + little(0xe000, 2) + little(item.size(), 4) + item;
  return element(group, number, "SQ", all);
}

std::string unsignedShort(unsigned group, unsigned number, unsigned value) {
  return element(group, number, "US", little(value, 2));
}

}  // namespace

void writeMultiFrame(const std::filesystem::path& file, const std::vector<double>& places_mm) {
  const std::string storage = "1.2.840.10008.5.1.4.1.1.2.1", instance = "1.2.3.4.5.6";
  const std::string meta = element(2, 1, "OB", std::string("\0\1", 2)) +
                           element(2, 2, "UI", storage) + element(2, 3, "UI", instance) +
                           element(2, 0x10, "UI", "1.2.840.10008.1.2.1");
  std::vector<std::string> frames;
  std::string pixels;
  for (std::size_t f = 0; f < places_mm.size(); ++f) {
    frames.push_back(sequence(
        0x20, 0x9113, {element(0x20, 0x32, "DS", "10\\20\\" + std::to_string(places_mm[f]))}));
    for (std::size_t i = 0; i < 20; ++i) pixels += little(20 * f + i, 2);
  }
  const std::string shared =
      sequence(0x20, 0x9116, {element(0x20, 0x37, "DS", "1\\0\\0\\0\\1\\0")}) +
      sequence(0x28, 0x9110, {element(0x28, 0x30, "DS", "0.6\\0.5")}) +
      sequence(0x28, 0x9145,
               {element(0x28, 0x1052, "DS", "-1000") + element(0x28, 0x1053, "DS", "1")});
  std::ofstream(file, std::ios::binary)
      << std::string(128, '\0') << "DICM" << element(2, 0, "UL", little(meta.size(), 4)) << meta
      << element(8, 0x16, "UI", storage) << element(8, 0x18, "UI", instance)
      << element(8, 0x60, "CS", "CT") << element(0x20, 0xd, "UI", "1.2.9")
      << element(0x20, 0xe, "UI", "1.2.10") << unsignedShort(0x28, 2, 1)
      << element(0x28, 4, "CS", "MONOCHROME2")
      << element(0x28, 8, "IS", std::to_string(places_mm.size())) << unsignedShort(0x28, 0x10, 4)
      << unsignedShort(0x28, 0x11, 5) << unsignedShort(0x28, 0x100, 16)
      << unsignedShort(0x28, 0x101, 16) << unsignedShort(0x28, 0x102, 15)
      << unsignedShort(0x28, 0x103, 1) << sequence(0x5200, 0x9229, {shared})
      << sequence(0x5200, 0x9230, frames) << element(0x7fe0, 0x10, "OW", pixels);
}

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
