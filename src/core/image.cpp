#include "core/image.h"

#include "core/parallel.h"

namespace softscope {
namespace {

/// Combines blocks of four pixels.
template <class Merge>
Raster<std::uint8_t> halvedBy(const Raster<std::uint8_t>& fine, const Merge& merge) {
  const int width = fine.width_px / 2;
  Raster<std::uint8_t> half(width, fine.height_px / 2);
  parallelRows(half.height_px, [&](int v) {
    const std::uint8_t *a = fine.row(2 * v), *b = fine.row(2 * v + 1);
    std::uint8_t* out = half.row(v);
    for (int u = 0; u < width; ++u)
      out[u] = static_cast<std::uint8_t>(merge(a[2 * u], a[2 * u + 1], b[2 * u], b[2 * u + 1]));
  });
  return half;
}

}  // namespace

GrayImage toGray(const ColourImage& colour) {
  const int width = colour.width_px;
  GrayImage gray(width, colour.height_px);
  parallelRows(colour.height_px, [&](int v) {
    const Rgb8* in = colour.row(v);
    std::uint8_t* out = gray.row(v);
    for (int u = 0; u < width; ++u) out[u] = toGray(in[u]);
  });
  return gray;
}

GrayImage halve(const GrayImage& image) { return halvedBy(image, meanOfFour); }

Mask halvedMask(const Mask& mask) {
  return halvedBy(mask, [](int a, int b, int c, int d) { return (a | b | c | d) != 0 ? 1 : 0; });
}

}  // namespace softscope
