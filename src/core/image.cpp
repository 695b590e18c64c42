#include "core/image.h"

#include "core/parallel.h"

namespace softscope {

GrayImage toGray(const ColourImage& colour) {
  GrayImage gray(colour.width_px, colour.height_px);
  parallelRows(colour.height_px, [&](int v) {
    const Rgb8* in = colour.row(v);
    std::uint8_t* out = gray.row(v);
    for (int u = 0; u < colour.width_px; ++u) out[u] = toGray(in[u]);
  });
  return gray;
}

}  // namespace softscope
