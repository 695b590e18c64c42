// src/core/decimal_number.h: locale-independent parsing of numbers.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace softscope {

/// Parses the whole word: 1, -.5, 5., +3e-2; for floating-point
/// types also nan and inf. Other forms are rejected: hexadecimal,
/// decimal comma, trailing characters, out of range of `Number`.
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
