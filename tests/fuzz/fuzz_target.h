// tests/fuzz/fuzz_target.h: what a reader may do with any bytes: a value, or a one-line error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "core/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace softscope::test {

/// Ends the program where the reader returned what its header rules out.
inline void mustHold(bool holds) {
  if (!holds) std::abort();
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// What `read` returns, or nothing where it throws one of softscope's errors; any other exception,
/// or an error of several lines, ends the program.
template <class Read>
auto answerOf(const Read& read) noexcept -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const Error& error) {
    mustHold(std::string(error.what()).find('\n') == std::string::npos);
    return std::nullopt;
  }
}

}  // namespace softscope::test
