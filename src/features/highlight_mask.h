// src/features/highlight_mask.h: specular highlight mask.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 at specular highlights: bright and colourless pixels, and their surroundings. Same shape.
Mask highlightMask(const ColourImage& image);

}  // namespace softscope
