// eval/images/dense_answer.h: dense depth with gaps filled, and occlusion mask.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Each unmeasured (NaN) pixel takes the value of the nearest measured one, by steps along rows and
/// columns. All NaN stays all NaN.
Raster<float> fillFromNearest(const Raster<float>& depth_mm);

/// Non-zero where the right camera does not see the surface point of a left pixel: its match lies
/// outside the image, or behind a surface whose disparity is more than `margin_px` larger. Unknown
/// truth (NaN) is 0.
Mask hiddenInRight(const Raster<float>& true_disparity_px, double margin_px = 1);

}  // namespace softscope
