// src/features/mask_morphology.h: masks grow, shrink, and lose their specks.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 wherever a non-zero pixel lies within `radius_px` rows and columns, else 0.
Mask grown(const Mask& mask, int radius_px);

/// 1 wherever all pixels within `radius_px` rows and columns (and inside the picture) are not 0.
Mask shrunk(const Mask& mask, int radius_px);

}  // namespace softscope
