// src/stereo/images/spread.h: marks grow into squares.
#pragma once

#include <cstdint>

#include "core/raster.h"

namespace softscope {

/// 1 wherever a 1 lies within `radius_px` rows and columns, else 0. `marks` are 0 or 1.
Raster<std::uint8_t> spread(const Raster<std::uint8_t>& marks, int radius_px);

}  // namespace softscope
