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

GrayImage halve(const GrayImage& image) {
  GrayImage half(image.width_px / 2, image.height_px / 2);
  parallelRows(half.height_px, [&](int v) {
    const std::uint8_t *a = image.row(2 * v), *b = image.row(2 * v + 1);
    std::uint8_t* out = half.row(v);
    for (int u = 0; u < half.width_px; ++u)
      out[u] = meanOfFour(a[2 * u], a[2 * u + 1], b[2 * u], b[2 * u + 1]);
  });
  return half;
}

Mask halvedMask(const Mask& mask) {
  Mask half(mask.width_px / 2, mask.height_px / 2);
  parallelRows(half.height_px, [&](int v) {
    const std::uint8_t *a = mask.row(2 * v), *b = mask.row(2 * v + 1);
    std::uint8_t* out = half.row(v);
    for (int u = 0; u < half.width_px; ++u)
      out[u] = (a[2 * u] | a[2 * u + 1] | b[2 * u] | b[2 * u + 1]) != 0 ? 1 : 0;
  });
  return half;
}

}  // namespace softscope
