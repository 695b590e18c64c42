#include "core/image.h"

#include "core/parallel.h"

namespace softscope {

GrayImage toGray(const ColourImage& colour) {
  GrayImage gray(colour.width_px, colour.height_px);
  parallelRows(colour.height_px, [&](int v) {
    const Rgb8* in = colour.row(v);
    std::uint8_t* out = gray.row(v);
    for (int u = 0; u < colour.width_px; ++u) {
      // Weights in 1/65536, so that the result is the same on every machine.
      out[u] = static_cast<std::uint8_t>(
          (19595 * in[u].red + 38470 * in[u].green + 7471 * in[u].blue + 32768) >> 16);
    }
  });
  return gray;
}

}  // namespace softscope
