// src/stereo/rectification/row_resampling.h: vertical resampling by a fraction of a pixel.
#pragma once

#include "core/image.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// The image moved so that the model's row difference vanishes: (u, v) shows what was at
/// v + alignment.at(u, v), by a cubic through four rows; beyond the image its last row is
/// repeated.
GrayImage moveRows(const GrayImage& picture, const RowAlignment& alignment);
ColourImage moveRows(const ColourImage& picture, const RowAlignment& alignment);

}  // namespace softscope
