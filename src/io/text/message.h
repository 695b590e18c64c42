// src/io/text/message.h: one-line texts for errors.
#pragma once

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

namespace softscope {

/// Concatenates its parts, numbers with up to six digits.
template <class... Parts>
std::string say(const Parts&... parts) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  (text << ... << parts);
  return text.str();
}

/// One line: control characters of terminals (escape, line break, U+009B) become `?`.
std::string printable(std::string_view text);

/// Excerpt of a file in backticks: at most `most` characters,
/// unprintable ones as `?`, so that an error is one line.
std::string excerpt(std::string_view found, std::size_t most = 40);

/// Path in messages; unprintable characters as `?`.
std::string shown(const std::filesystem::path& path);

}  // namespace softscope
