// src/stereo/images/view_masks.h: pixels of both views that must not be matched.
#pragma once

#include "core/image.h"

namespace softscope {

/// Non-zero: outside the tissue (instrument, even border, outside the raw image). Each is empty or
/// has its view's shape.
struct ViewMasks {
  Mask left, right;
};

/// Masked in either; each may be empty.
Mask united(const Mask& one, const Mask& other);

/// NaN under the mask; unchanged for an empty mask or one of another shape.
void dropMasked(const Mask& mask, Raster<float>* raster);

/// The image with masked pixels replaced by a smooth continuation of the
/// others (means over squares of doubling size), without a gradient at the
/// edge of the mask. Unchanged if `mask` is empty or covers everything.
GrayImage fillMasked(const GrayImage& image, const Mask& mask);

/// A pair ready for matching: gray, filled where ignored.
struct MatchableViews {
  GrayImage left, right;
  ViewMasks ignored;
};
MatchableViews matchableViews(const GrayImage& left, const GrayImage& right,
                              const ViewMasks& ignored);

}  // namespace softscope
