// src/core/image.h: what a camera saw.
#pragma once

#include <cstdint>

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

/// Non-zero = ignore this pixel (instrument, or outside the scope's circle).
using Mask = Raster<std::uint8_t>;

/// Luma by ITU-R BT.601: 0.299 R + 0.587 G + 0.114 B, rounded.
GrayImage toGray(const ColourImage& colour);

/// The two pictures of one moment.
struct StereoPair {
  ColourImage left;
  ColourImage right;
};

}  // namespace softscope
