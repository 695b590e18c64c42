// src/features/highlight_mask.h: specular highlights, and what of them is clipped.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 at specular highlights: bright and unsaturated pixels, dilated. Same size.
Mask highlightMask(const ColourImage& image);

/// 1 inside of clipped highlights, which show nothing of the tissue: all channels of all
/// pixels of their window of stereo are at their end. Same size, or empty if none is.
Mask clippedMask(const ColourImage& image);

}  // namespace softscope
