// toolkit/face/image_copies.h: images of the public face to those of core, and back.
#pragma once

#include "core/image.h"
#include "softscope/frame.h"

namespace softscope::api {

/// One channel becomes three equal ones. Throws InputError naming `what`: no values, no such count
/// of channels.
ColourImage colourImageOf(const ImageView& view, const char* what);
/// Empty where the view is. Throws InputError where it has more than one channel.
Mask maskOf(const ImageView& view);

Image imageOf(const ColourImage& image);
Image imageOf(const Mask& mask);

}  // namespace softscope::api
