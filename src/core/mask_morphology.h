// src/core/mask_morphology.h: dilation and erosion of masks with a square.
#pragma once

#include "core/image.h"

namespace softscope {

/// 1 for pixels with a non-zero pixel within `radius_px` rows and columns, else 0.
Mask dilated(const Mask& mask, int radius_px);

/// 1 for pixels whose neighbours within `radius_px` (inside the image) are all non-zero.
Mask eroded(const Mask& mask, int radius_px);

}  // namespace softscope
