// src/fusion/colour_levels.h: colours scaled and rounded to 8 bits.
#pragma once

#include <cstdint>

#include "core/hd.h"
#include "core/image.h"

namespace softscope {

SOFTSCOPE_HD inline std::uint8_t toByte(float level) {
  return static_cast<std::uint8_t>(level >= 254.5f ? 255.0f : (level > 0 ? level + 0.5f : 0.0f));
}

/// Multiplies every channel by its factor: image = colour of the model times gain, and back.
SOFTSCOPE_HD inline Rgb8 scaled(Rgb8 colour, float red, float green, float blue) {
  return {toByte(static_cast<float>(colour.red) * red),
          toByte(static_cast<float>(colour.green) * green),
          toByte(static_cast<float>(colour.blue) * blue)};
}

}  // namespace softscope
