// eval/images/pixel_masks.h: masks of pixels excluded from a comparison. Non-zero = ignore.
#pragma once

#include "core/image.h"
#include "core/raster.h"

namespace softscope {

/// Ignores pixels without a value. With the map of one method in the
/// evaluation of another, both are evaluated on the same pixels.
Mask ignoreUnmeasured(const Raster<float>& values);

/// Ignores pixels with unknown disparity, or with the match u - disparity
/// outside of the image. Occlusion inside the image is not considered.
Mask ignoreMatchesOutside(const Raster<float>& disparity_px);

/// Union of two masks; an empty mask ignores nothing. Throws InputError for different sizes.
Mask ignoreEither(const Mask& first, const Mask& second);

/// Throws InputError unless the mask is empty or has the size of the map named `what`.
void requireSameShape(const Raster<float>& map, const Mask& mask, const char* what);

/// Throws InputError unless both maps have the same size.
void requireSameShape(const Raster<float>& measured, const Raster<float>& truth, const char* what);

}  // namespace softscope
