// eval/images/pixel_masks.h: masks of pixels that a comparison ignores. Non-zero = ignore.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Ignores pixels without a value: hand one method's map to another's evaluation, and both are
/// judged on the pixels that both measured.
Mask ignoreUnmeasured(const Raster<float>& values);

/// Ignores pixels whose disparity is unknown, or whose match u - disparity lies outside the
/// image. Occlusion inside the image is not looked at.
Mask ignoreMatchesOutside(const Raster<float>& disparity_px);

/// Ignores what either ignores; an empty mask ignores nothing. Throws InputError for two shapes.
Mask ignoreEither(const Mask& first, const Mask& second);

/// Throws InputError unless the mask is empty or as large as the map named `what`.
void requireSameShape(const Raster<float>& map, const Mask& mask, const char* what);

/// Throws InputError unless both maps are of one size.
void requireSameShape(const Raster<float>& measured, const Raster<float>& truth, const char* what);

}  // namespace softscope
