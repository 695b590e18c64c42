// src/core/image.h: 8-bit grey and colour images.
#pragma once

#include <cstdint>

#include "core/hd.h"
#include "core/raster.h"

namespace softscope {

struct Rgb8 {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Rgb8& other) const {
    return red == other.red && green == other.green && blue == other.blue;
  }
};

using GrayImage = Raster<std::uint8_t>;
using ColourImage = Raster<Rgb8>;

/// Non-zero = ignore this pixel (instrument, or outside of the circular image of the scope).
using Mask = Raster<std::uint8_t>;

/// Luma of ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B, rounded.
SOFTSCOPE_HD inline std::uint8_t toGray(Rgb8 colour) {
  // Weights in 1/65536, for the same result on every machine.
  return static_cast<std::uint8_t>(
      (19595 * colour.red + 38470 * colour.green + 7471 * colour.blue + 32768) >> 16);
}
GrayImage toGray(const ColourImage& colour);

/// Rounded.
SOFTSCOPE_HD inline std::uint8_t meanOfFour(std::uint8_t a, std::uint8_t b, std::uint8_t c,
                                            std::uint8_t d) {
  return static_cast<std::uint8_t>((a + b + c + d + 2) / 4);
}
/// Means of 2 x 2 pixels, rounded; an odd last row or column is dropped. Pixel
/// (u, v) of the half image is at (2 u + 0.5, 2 v + 0.5) of the full image.
GrayImage halve(const GrayImage& image);
/// Half size: 1 if one of four pixels is non-zero; an empty mask stays empty.
Mask halvedMask(const Mask& mask);

/// The two images of one time.
struct StereoPair {
  ColourImage left;
  ColourImage right;
};

}  // namespace softscope
