// src/stereo/rectification/image_border.h: the even border that rectification, cropping or the
// scope's aperture leaves in an image.
#pragma once

#include "core/image.h"
#include "stereo/images/view_masks.h"
#include "stereo/rectification/rectifier.h"

namespace softscope {

/// Non-zero in the border; empty where there is none. The border is connected to the image's edge
/// and holds no signal, not even noise: squares of 11 x 11 pixels whose largest channels are all
/// black, or of the level that most pixels of the edge have (up to half of the range: video levels,
/// a recorder's surround), and equal to their neighbours to one level; and the pixels like them up
/// to 8 px beside (a codec blurs the cut). A dark background with the sensor's noise is no border;
/// one that a codec has made even is. Nor is a border what leaves less than a quarter of the image.
Mask findBorder(const ColourImage& image);

/// Pixels of a rectified pair known to be no tissue before matching:
/// those outside of the raw images, and, on request, the borders.
ViewMasks pixelsToIgnore(const StereoPair& rectified, const Rectifier& rectifier, bool find_border);

}  // namespace softscope
