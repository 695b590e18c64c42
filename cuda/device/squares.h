// cuda/device/squares.h: four pixels that become one of an image of half the size.
#pragma once

#include <cstdint>

#include "core/image.h"
#include "cuda/device/kernel.h"

namespace softscope::cuda {

/// Rounded mean of the square's gray levels, as halve() has it.
SOFTSCOPE_HD inline std::uint8_t meanOfSquare(const View<const std::uint8_t>& whole, int u, int v) {
  const std::uint8_t *upper = whole.row(2 * v) + 2 * u, *lower = whole.row(2 * v + 1) + 2 * u;
  return meanOfFour(upper[0], upper[1], lower[0], lower[1]);
}

/// The bits that any of its pixels has.
SOFTSCOPE_HD inline std::uint8_t bitsOfSquare(const View<const std::uint8_t>& whole, int u, int v) {
  const std::uint8_t *upper = whole.row(2 * v) + 2 * u, *lower = whole.row(2 * v + 1) + 2 * u;
  return static_cast<std::uint8_t>(upper[0] | upper[1] | lower[0] | lower[1]);
}

}  // namespace softscope::cuda
