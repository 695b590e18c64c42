// src/core/decimal_number.h: the one way from a word of a file or command line to a number.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace softscope {

/// The whole word as a number, whatever the locale: 1, -.5, 5., +3e-2; of floating-point numbers
/// also nan and inf. Nothing else is one: no hexadecimal number, no decimal comma, nothing behind
/// the number, none that `Number` can't hold.
template <class Number>
std::optional<Number> decimalNumber(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  Number value{};
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

}  // namespace softscope
