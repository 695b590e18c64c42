// src/io/text/text_lines.h: lines, words and numbers of a text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softscope {

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// Lines without their ends (\n or \r\n); views into `text`.
std::vector<std::string_view> linesOf(std::string_view text);

/// Words parted by blanks or commas; views into `text`.
std::vector<std::string_view> wordsOf(std::string_view text);

std::string lowerCase(std::string_view text);

/// The whole word as a number, whatever the locale: 1, -.5, 3e-2, nan, .Nan, inf, -.Inf.
std::optional<double> numberOf(std::string_view word);

/// The shortest text that reads back as the same double.
std::string exactText(double value);

/// One line that holds nothing but numbers.
struct NumberRow {
  int line = 0;  // from 1
  std::vector<double> values;
};

/// The lines that hold nothing but numbers (blanks, commas, semicolons between them); all other
/// lines, such as headings and comments, are left out.
std::vector<NumberRow> numberRows(std::string_view text);

}  // namespace softscope
