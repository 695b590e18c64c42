// src/stereo/refinement/mask_leaks.h: disparities next to an instrument mask that may be its own.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// 1 where a disparity next to `mask` may be that of the masked surface: windows that reach
/// under the mask contain the edge of the instrument, and give its disparity to the tissue next
/// to it. All pixels within half a window of the mask, and, within the reach of a window at
/// half size, those that a step separates from the tissue beyond: no short path over measured
/// neighbours, whose disparities differ by less than a step, leads there. `disparity_px` is NaN
/// if unmeasured, also under the mask. Throws Error if the shapes differ.
Mask leaksOf(const Mask& mask, const Raster<float>& disparity_px);

}  // namespace softscope
