// src/features/integral_image.h: integral images: sums over rectangles by four look-ups.
#pragma once

#include <cstdint>

#include "core/raster.h"

namespace softscope {

/// (width + 1) x (height + 1): value (u, v) sums all pixels left of and above (u, v), exclusive.
/// Images above 8 megapixels of full white would overflow: 2^31 / 255.
template <class Pixel, class Value>
Raster<std::int32_t> integralImage(const Raster<Pixel>& image, const Value& valueOf) {
  Raster<std::int32_t> sums(image.width_px + 1, image.height_px + 1, 0);
  for (int v = 0; v < image.height_px; ++v) {
    const Pixel* in = image.row(v);
    const std::int32_t* above = sums.row(v) + 1;
    std::int32_t* out = sums.row(v + 1) + 1;
    std::int32_t row_sum = 0;
    for (int u = 0; u < image.width_px; ++u) {
      row_sum += valueOf(in[u]);
      out[u] = above[u] + row_sum;
    }
  }
  return sums;
}

}  // namespace softscope
