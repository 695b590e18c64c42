// src/stereo/refinement/mask_leaks.h: disparities beside an instrument mask that may be its own.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// 1 where a disparity beside `mask` may be that of the surface under it: windows that reach under
/// the mask see the instrument's edge, and give its disparity to the tissue beside it. All pixels
/// within half a window of the mask, and of those within the reach of a window at half size those
/// that a step parts from the tissue beyond: no short way over measured neighbours, whose
/// disparities differ by less than a step, leads there.
/// `disparity_px` is NaN where unmeasured, also under the mask. Throws Error if the shapes differ.
Mask leaksOf(const Mask& mask, const Raster<float>& disparity_px);

}  // namespace softscope
