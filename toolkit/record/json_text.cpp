#include "toolkit/record/json_text.h"

#include <array>
#include <cstdio>

namespace softscope {

namespace {

/// JSON requires escapes only below U+0020; DEL and U+0080 to U+009F are escaped as well.
std::string escapedControls(const std::string& json) {
  std::string out;
  for (std::size_t i = 0; i < json.size(); ++i) {
    const auto byte = static_cast<unsigned char>(json[i]);
    const auto next = static_cast<unsigned char>(i + 1 < json.size() ? json[i + 1] : 0);
    const bool long_control = byte == 0xc2 && next >= 0x80 && next < 0xa0;
    if (byte != 127 && !long_control) {
      out += json[i];
      continue;
    }
    std::array<char, 8> escape{};
    std::snprintf(escape.data(), escape.size(), "\\u%04x", long_control ? next : byte);
    out += escape.data();
    i += long_control ? 1 : 0;
  }
  return out;
}

}  // namespace

std::string jsonText(const FactSheet::Json& json) {
  const std::string text = json.dump(2, ' ', false, FactSheet::Json::error_handler_t::replace);
  return escapedControls(text) + "\n";
}

}  // namespace softscope
