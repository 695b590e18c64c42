// src/core/mask_morphology.h: dilation and erosion of masks by squares.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 wherever a non-zero pixel lies within `radius_px` rows and columns, else 0.
Mask dilated(const Mask& mask, int radius_px);

/// 1 wherever all pixels within `radius_px` rows and columns (and inside the image) are not 0.
Mask eroded(const Mask& mask, int radius_px);

}  // namespace softscope
