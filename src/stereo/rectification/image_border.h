// src/stereo/rectification/image_border.h: the black border that rectification, cropping or the
// scope's aperture leaves in an image.
#pragma once

#include "core/image.h"
#include "stereo/images/view_masks.h"
#include "stereo/rectification/rectifier.h"

namespace softscope {

/// Non-zero in the black border; empty where there is none. The border is connected to the image's
/// edge and holds no signal, not even noise: squares of 11 x 11 pixels that are all black in all
/// channels and equal to their neighbours to one level, and the dark pixels up to 8 px beside them
/// (a codec blurs the cut). A dark background with the sensor's noise is no border; one that a
/// codec has made even is. Nor is a border what leaves less than a quarter of the image.
Mask findBlackBorder(const ColourImage& image);

/// Pixels of a rectified pair known to be no tissue before matching:
/// those outside of the raw images, and, on request, the black borders.
ViewMasks pixelsToIgnore(const StereoPair& rectified, const Rectifier& rectifier, bool find_border);

}  // namespace softscope
