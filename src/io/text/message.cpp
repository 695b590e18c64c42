#include "io/text/message.h"

#include <algorithm>

namespace softscope {
std::string printable(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    // Bytes from 128 on are UTF-8 and kept, except U+0080 to U+009F, which are controls.
    const bool long_control = byte == 0xc2 && next >= 0x80 && next < 0xa0;
    out += byte < 32 || byte == 127 || long_control ? '?' : text[i];
    if (long_control) ++i;
  }
  return out;
}

std::string excerpt(std::string_view found, std::size_t most) {
  const std::string_view head = found.substr(0, std::min(found.size(), most));
  return "`" + printable(head) + (found.size() > most ? "…`" : "`");
}

std::string shown(const std::filesystem::path& path) { return printable(path.string()); }

}  // namespace softscope
