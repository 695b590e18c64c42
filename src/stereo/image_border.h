// src/stereo/image_border.h: the black border that rectification, cropping or the scope's aperture
// leaves in an image.
#pragma once

#include "core/image.h"
#include "stereo/rectifier.h"
#include "stereo/view_masks.h"

namespace softscope {

/// Non-zero in the black border; empty where there is none. The border is connected to the image's
/// edge and holds no signal, not even noise: squares of 11 x 11 pixels that are all black in all
/// channels and equal to their neighbours to one level, and the dark pixels up to 8 px beside them
/// (a codec blurs the cut). Dark background of a scene has the sensor's noise and is no border; nor
/// is what leaves less than a quarter of the image.
Mask findBlackBorder(const ColourImage& image);

/// All that is known to be no tissue in a rectified pair: `mask` of the left view (may be empty),
/// what lies outside the raw images, and, where asked for, the black borders.
ViewMasks pixelsToIgnore(const StereoPair& rectified, const Rectifier& rectifier, const Mask& mask,
                         bool find_border);

}  // namespace softscope
