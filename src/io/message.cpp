#include "io/message.h"

#include <algorithm>

namespace softscope {
namespace {

std::string printable(std::string_view text) {
  std::string out(text);
  // Bytes from 128 on are UTF-8 and stay.
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  return out;
}

}  // namespace

std::string excerpt(std::string_view found) {
  constexpr std::size_t kMost = 40;
  const std::string_view head = found.substr(0, std::min(found.size(), kMost));
  return "`" + printable(head) + (found.size() > kMost ? "…`" : "`");
}

std::string shown(const std::filesystem::path& path) { return printable(path.string()); }

}  // namespace softscope
