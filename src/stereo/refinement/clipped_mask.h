// src/stereo/refinement/clipped_mask.h: pixels whose windows show nothing of the tissue.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 inside of clipped highlights: all channels of all pixels within the window of the sub-pixel
/// refinement are at their end. Same size, or empty if none is.
Mask clippedMask(const ColourImage& image);

}  // namespace softscope
