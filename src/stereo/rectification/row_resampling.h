// src/stereo/rectification/row_resampling.h: every pixel from a little above or below.
#pragma once

#include "core/image.h"
#include "stereo/rectification/row_alignment.h"

namespace softscope {

/// The picture moved so that the model's row difference vanishes: (u, v) shows what was at
/// v + alignment.at(u, v), by a cubic through four rows; beyond the picture its last row is
/// repeated.
GrayImage moveRows(const GrayImage& picture, const RowAlignment& alignment);
ColourImage moveRows(const ColourImage& picture, const RowAlignment& alignment);

}  // namespace softscope
