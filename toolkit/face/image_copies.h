// toolkit/face/image_copies.h: conversion of images between the public interface and core.
#pragma once

#include "core/frame.h"
#include "core/image.h"
#include "core/stereo_rig.h"
#include "softscope/frame.h"

namespace softscope::api {

/// One channel becomes three equal channels. Throws InputError
/// with `what`: no values, an unsupported number of channels.
ColourImage colourImageOf(const ImageView& view, const char* what);
/// Empty for an empty view. Throws InputError for more than one channel.
Mask maskOf(const ImageView& view);

Image imageOf(const ColourImage& image);
Image imageOf(const Mask& mask);

/// Checks both images and the mask. Throws InputError if one does not fit
/// the calibration: the stages would skip such a frame like a damaged file.
softscope::Frame frameOf(const FrameView& view, const StereoCalibration& calibration, int index);

/// Throws InputError if images of `sequence` do not fit `calibration`.
void requireFit(const StereoCalibration& sequence, const StereoCalibration& calibration);

/// Returns its argument. Throws InputError if the image size is unknown.
const StereoCalibration& sized(const StereoCalibration& calibration);

}  // namespace softscope::api
