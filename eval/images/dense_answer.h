// eval/images/dense_answer.h: dense depth with gaps filled, and occlusion mask.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Each unmeasured (NaN) pixel gets the value of the nearest measured
/// pixel, by steps along rows and columns. All NaN remains all NaN.
Raster<float> fillFromNearest(const Raster<float>& depth_mm);

/// Non-zero for left pixels whose surface point is not visible to the right
/// camera: the match is outside of the image, or behind a surface with a
/// disparity larger by more than `margin_px`. Unknown truth (NaN) gives 0.
Mask hiddenInRight(const Raster<float>& true_disparity_px, double margin_px = 1);

}  // namespace softscope
