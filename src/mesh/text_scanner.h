// src/mesh/text_scanner.h: words and numbers of a text file with their positions.
#pragma once

#include <string>
#include <string_view>

#include "core/decimal_number.h"
#include "core/error.h"

namespace softscope {

class TextScanner {
 public:
  /// `name` is used in errors; `line`: number of the
  /// first line of `text`. Keeps references to both.
  TextScanner(std::string_view text, std::string_view name, int line = 1)
      : text_(text), name_(name), line_(line) {}

  /// Next word, on this line or a later one; empty at the end.
  std::string_view word() {
    while (at_ < text_.size() && isSpace(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !isSpace(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// Rest of this line without its end; advances to the next line.
  std::string_view restOfLine() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
    std::string_view rest = text_.substr(begin, at_ - begin);
    if (at_ < text_.size()) ++at_, ++line_;
    if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
    return rest;
  }

  double number() { return toNumber<double>(word()); }

  /// Parses the whole word as a number.
  template <class Number>
  Number toNumber(std::string_view word) const {
    if (word.empty()) fail("the text ends where a number is expected");
    const auto value = decimalNumber<Number>(word);
    if (!value) fail("found " + shownWord(word) + " where a number is expected");
    return *value;
  }

  bool atEnd() {
    while (at_ < text_.size() && isSpace(text_[at_])) line_ += text_[at_++] == '\n';
    return at_ == text_.size();
  }
  std::size_t position() const { return at_; }
  int line() const { return line_; }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(std::string(name_) + ", line " + std::to_string(line_) + ": " + what +
                     "; export the mesh again");
  }

  /// Word in quotes: shortened, unprintable characters as `?`.
  static std::string shownWord(std::string_view word) {
    std::string shown(word.substr(0, 40));
    for (char& c : shown)
      if (c < ' ' || c > '~') c = '?';
    return "\"" + shown + "\"";
  }

 private:
  static bool isSpace(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
  }

  std::string_view text_;
  std::string_view name_;
  std::size_t at_ = 0;
  int line_;
};

}  // namespace softscope
