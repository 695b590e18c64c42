#include "io/geometry/pfm_file.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "io/images/picture_limits.h"
#include "io/text/message.h"
#include "io/text/text_lines.h"

namespace softscope {
namespace {

struct Header {
  int width_px = 0;
  int height_px = 0;
  bool big_endian = false;
  std::size_t data_begin = 0;
};

bool isPfmBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Next word of the header; `at` is then at the blank after it.
std::string_view takeWord(std::string_view bytes, std::size_t& at) {
  while (at < bytes.size() && isPfmBlank(bytes[at])) ++at;
  const std::size_t begin = at;
  while (at < bytes.size() && at - begin < 32 && !isPfmBlank(bytes[at])) ++at;
  return bytes.substr(begin, at - begin);
}

Header headerOf(std::string_view bytes, const std::string& name) {
  if (bytes.substr(0, 2) == "PF")
    throw InputError(name + ": a colour PFM, but one channel (Pf) is expected.");
  if (bytes.substr(0, 2) != "Pf")
    throw InputError(name + ": not a PFM file, which begins with Pf.");
  std::size_t at = 2;
  const auto width = numberOf(takeWord(bytes, at)), height = numberOf(takeWord(bytes, at));
  const auto scale = numberOf(takeWord(bytes, at));
  if (!width || !height || !scale || !(std::abs(*width) < 1e9) || !(std::abs(*height) < 1e9) ||
      *width != std::floor(*width) || *height != std::floor(*height) || !std::isfinite(*scale) ||
      *scale == 0 || at >= bytes.size())
    throw InputError(name +
                     ": its header is damaged; `Pf`, width, height and a scale are expected.");
  requirePictureSize(static_cast<long>(*width), static_cast<long>(*height), name);
  return {static_cast<int>(*width), static_cast<int>(*height), *scale > 0, at + 1};
}

float floatAt(const char* raw, bool big_endian) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
    bits |= std::uint32_t{static_cast<std::uint8_t>(raw[big_endian ? 3 - i : i])} << (8 * i);
  float value;
  std::memcpy(&value, &bits, 4);
  return std::isfinite(value) ? value : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

Raster<float> parsePfm(std::string_view bytes, const std::string& name) {
  const Header header = headerOf(bytes, name);
  const std::size_t expected = std::size_t{4} * static_cast<std::size_t>(header.width_px) *
                               static_cast<std::size_t>(header.height_px);
  const std::string_view data = bytes.substr(header.data_begin);
  if (data.size() != expected)
    throw InputError(say(name, ": holds ", data.size(), " bytes of numbers, but ", header.width_px,
                         " x ", header.height_px, " pixels need ", expected, ". Copy it again."));
  Raster<float> out(header.width_px, header.height_px);
  const char* raw = data.data();
  for (int v = header.height_px - 1; v >= 0; --v)
    for (int u = 0; u < header.width_px; ++u, raw += 4)
      out.at(u, v) = floatAt(raw, header.big_endian);
  return out;
}

std::string pfmBytes(const Raster<float>& raster) {
  std::string out = say("Pf\n", raster.width_px, " ", raster.height_px, "\n-1.0\n");
  out.reserve(out.size() + 4 * raster.size());
  for (int v = raster.height_px - 1; v >= 0; --v)
    for (int u = 0; u < raster.width_px; ++u) {
      std::uint32_t bits;
      std::memcpy(&bits, &raster.at(u, v), 4);
      for (int i = 0; i < 4; ++i) out += static_cast<char>(bits >> (8 * i) & 0xFF);
    }
  return out;
}

}  // namespace softscope
