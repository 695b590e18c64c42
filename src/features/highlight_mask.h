// src/features/highlight_mask.h: where the light is mirrored, and the tissue can't be seen.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 at specular highlights: bright and colourless pixels, and their surroundings. Same shape.
Mask highlightMask(const ColourImage& image);

}  // namespace softscope
