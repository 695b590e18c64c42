// src/stereo/rectification/row_resampling.h: vertical resampling by a fraction of a pixel.
#pragma once

#include "core/image.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// The image with the row difference of the model removed: (u, v)
/// shows the value at v + alignment.at(u, v), by a cubic through
/// four rows; outside of the image its last row is repeated.
GrayImage moveRows(const GrayImage& picture, const RowAlignment& alignment);
ColourImage moveRows(const ColourImage& picture, const RowAlignment& alignment);
/// Masked where a masked pixel contributes to the moved image.
Mask moveMaskRows(const Mask& mask, const RowAlignment& alignment);

}  // namespace softscope
