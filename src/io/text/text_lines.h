// src/io/text/text_lines.h: lines, words and numbers of a text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Without surrounding blanks.
std::string_view trimmed(std::string_view text);

/// Without the byte-order mark of UTF-8.
std::string_view withoutByteOrderMark(std::string_view text);

/// The same; throws InputError for UTF-16. `name` is used in the error.
std::string_view utf8Text(std::string_view bytes, const std::string& name);

/// Lines without their ends (\n or \r\n); views into `text`.
std::vector<std::string_view> linesOf(std::string_view text);

/// Words separated by blanks or commas; views into `text`.
std::vector<std::string_view> wordsOf(std::string_view text);

std::string lowerCase(std::string_view text);

/// Parses the whole word, locale-independent: 1, -.5, 3e-2, nan, .Nan, inf, -.Inf.
std::optional<double> numberOf(std::string_view word);

/// Shortest text that gives the same double.
std::string exactText(double value);

/// With that many decimals, at most 80, as printf has it in the locale "C". Throws Error for more.
std::string fixedText(double value, int decimals);

/// Line of numbers only.
struct NumberRow {
  int line = 0;  // from 1
  std::vector<double> values;
};

/// Lines of numbers only (separated by blanks, commas, semicolons);
/// other lines, such as headings and comments, are skipped.
std::vector<NumberRow> numberRows(std::string_view text);

}  // namespace softscope
