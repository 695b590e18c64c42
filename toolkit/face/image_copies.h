// toolkit/face/image_copies.h: images of the public face to those of core, and back.
#pragma once

#include "core/frame.h"
#include "core/image.h"
#include "core/stereo_rig.h"
#include "softscope/frame.h"

namespace softscope::api {

/// One channel becomes three equal ones. Throws InputError naming `what`: no values, no such count
/// of channels.
ColourImage colourImageOf(const ImageView& view, const char* what);
/// Empty where the view is. Throws InputError where it has more than one channel.
Mask maskOf(const ImageView& view);

Image imageOf(const ColourImage& image);
Image imageOf(const Mask& mask);

/// Checks both images and the mask. Throws InputError where one does not fit the calibration:
/// stages themselves would skip such a frame, as they do a damaged file.
softscope::Frame frameOf(const FrameView& view, const StereoCalibration& calibration, int index);

/// The same calibration. Throws InputError where it does not say how large the images are.
const StereoCalibration& sized(const StereoCalibration& calibration);

}  // namespace softscope::api
