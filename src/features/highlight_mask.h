// src/features/highlight_mask.h: specular highlight mask.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 at specular highlights: bright and unsaturated pixels, dilated. Same size.
Mask highlightMask(const ColourImage& image);

}  // namespace softscope
