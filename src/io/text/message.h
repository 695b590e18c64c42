// src/io/text/message.h: one-line texts for errors.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace softscope {

/// Joins its parts, numbers with up to six digits.
template <class... Parts>
std::string say(const Parts&... parts) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  (text << ... << parts);
  return text.str();
}

/// One line: control characters, which a terminal would obey (escape, line break, U+009B), as `?`.
std::string printable(std::string_view text);

/// What a file said, in backticks: cut to `most` characters, unprintable ones as `?`, so that an
/// error stays one line whatever the file holds.
std::string excerpt(std::string_view found, std::size_t most = 40);

/// A path as it stands in messages; unprintable characters as `?`.
std::string shown(const std::filesystem::path& path);

}  // namespace softscope
