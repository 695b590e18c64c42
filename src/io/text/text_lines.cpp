#include "io/text/text_lines.h"

#include <array>
#include <charconv>
#include <limits>

#include "core/decimal_number.h"
#include "core/error.h"

namespace softscope {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\0'; }
bool isSeparator(char c) { return isBlank(c) || c == ',' || c == ';'; }

/// YAML writes .Nan, .Inf and -.Inf.
std::optional<double> specialNumber(std::string_view word) {
  const std::string name = lowerCase(word);
  if (name == "nan" || name == ".nan" || name == "-nan")
    return std::numeric_limits<double>::quiet_NaN();
  if (name == "inf" || name == ".inf") return std::numeric_limits<double>::infinity();
  if (name == "-inf" || name == "-.inf") return -std::numeric_limits<double>::infinity();
  return std::nullopt;
}

std::optional<std::vector<double>> numbersAlone(std::string_view line) {
  std::vector<double> values;
  for (const std::string_view word : wordsOf(line)) {
    const auto value = numberOf(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
  while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
  return text;
}

std::string_view withoutByteOrderMark(std::string_view text) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  return text;
}

std::string_view utf8Text(std::string_view bytes, const std::string& name) {
  const std::string_view head = bytes.substr(0, 2);
  if (head == "\xff\xfe" || head == "\xfe\xff")
    throw InputError(name + ": its text is UTF-16, but UTF-8 is expected. Save it as UTF-8.");
  return withoutByteOrderMark(bytes);
}

std::vector<std::string_view> linesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

std::vector<std::string_view> wordsOf(std::string_view text) {
  std::vector<std::string_view> words;
  std::size_t begin = 0;
  while (begin < text.size()) {
    while (begin < text.size() && isSeparator(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && !isSeparator(text[end])) ++end;
    if (end > begin) words.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return words;
}

std::string lowerCase(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

std::optional<double> numberOf(std::string_view word) {
  if (const auto value = decimalNumber<double>(word)) return value;
  return specialNumber(word);
}

std::string exactText(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string fixedText(double value, int decimals) {
  constexpr int kMostDecimals = 80;
  if (decimals > kMostDecimals)
    throw Error(std::to_string(decimals) + " decimals of a number, but at most " +
                std::to_string(kMostDecimals) + " are written");
  std::array<char, 400> buffer{};  // the largest number has 309 digits
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                    std::chars_format::fixed, decimals);
  return {buffer.data(), result.ptr};
}

std::vector<NumberRow> numberRows(std::string_view text) {
  std::vector<NumberRow> rows;
  int line_number = 0;
  for (const std::string_view line : linesOf(text)) {
    ++line_number;
    auto values = numbersAlone(line);
    if (values && !values->empty()) rows.push_back({line_number, std::move(*values)});
  }
  return rows;
}

}  // namespace softscope
