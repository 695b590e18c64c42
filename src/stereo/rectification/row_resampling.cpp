#include "stereo/rectification/row_resampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kPhases = 128;     // of a row: 1/256 px is the largest position error
constexpr int kWeightBits = 12;  // integers, for the same bytes on every machine
using Weights = std::array<int, 4>;

/// Catmull-Rom weights of four rows for every phase between the two in the middle.
std::array<Weights, kPhases> cubicWeights() {
  std::array<Weights, kPhases> table;
  for (int phase = 0; phase < kPhases; ++phase) {
    const double t = static_cast<double>(phase) / kPhases, one = 1 << kWeightBits;
    Weights& w = table[static_cast<std::size_t>(phase)];
    w[0] = static_cast<int>(std::lround(one * t * (-0.5 + t * (1 - 0.5 * t))));
    w[2] = static_cast<int>(std::lround(one * t * (0.5 + t * (2 - 1.5 * t))));
    w[3] = static_cast<int>(std::lround(one * t * t * (-0.5 + 0.5 * t)));
    w[1] = (1 << kWeightBits) - w[0] - w[2] - w[3];
  }
  return table;
}

/// Source of the pixels of row v, in 1 / kPhases of a row, inside the image.
void findSources(const RowAlignment& alignment, int v, int height, int width, int* source) {
  const float scale = static_cast<float>(1 / alignment.half_width_px);
  const float centre = static_cast<float>(alignment.centre_u_px);
  const float y = static_cast<float>(v - alignment.centre_v_px) * scale;
  float m[6];
  for (std::size_t k = 0; k < 6; ++k) m[k] = static_cast<float>(alignment.model[k]);
  const float constant = static_cast<float>(v) + m[0] + y * (m[2] + y * m[5]);
  const float linear = m[1] + y * m[4], quadratic = m[3];
  const float last = static_cast<float>(height - 1);
  for (int u = 0; u < width; ++u) {
    const float x = (static_cast<float>(u) - centre) * scale;
    const float row = std::min(std::max(constant + x * (linear + x * quadratic), 0.0f), last);
    source[u] = static_cast<int>(row * kPhases + 0.5f);
  }
}

/// One pixel of `channels` bytes from the same column of four rows.
template <int channels>
inline void mix(const Weights& w, const std::uint8_t* a, const std::uint8_t* b,
                const std::uint8_t* c, const std::uint8_t* d, std::uint8_t* out) {
  for (int i = 0; i < channels; ++i) {
    const int sum =
        w[0] * a[i] + w[1] * b[i] + w[2] * c[i] + w[3] * d[i] + (1 << (kWeightBits - 1));
    out[i] = static_cast<std::uint8_t>(std::clamp(sum >> kWeightBits, 0, 255));
  }
}

template <class Pixel>
Raster<Pixel> move(const Raster<Pixel>& picture, const RowAlignment& alignment) {
  constexpr int kChannels = sizeof(Pixel);  // of bytes
  const auto table = cubicWeights();
  const int width = picture.width_px, last = picture.height_px - 1;
  Raster<Pixel> moved(width, picture.height_px);
  const auto* in = reinterpret_cast<const std::uint8_t*>(picture.values.data());
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(width) * kChannels;
  parallelRanges(picture.height_px, 32, [&, width, last, stride](int begin, int end) {
    std::vector<int> source(static_cast<std::size_t>(width));
    for (int v = begin; v < end; ++v) {
      findSources(alignment, v, last + 1, width, source.data());
      auto* out = reinterpret_cast<std::uint8_t*>(moved.row(v));
      for (int u = 0; u < width; ++u) {
        const int row = source[static_cast<std::size_t>(u)] / kPhases;
        const auto phase = static_cast<std::size_t>(source[static_cast<std::size_t>(u)] % kPhases);
        const std::uint8_t* here = in + row * stride + kChannels * u;
        mix<kChannels>(table[phase], here - (row > 0 ? stride : 0), here,
                       here + (row < last ? stride : 0),
                       here + (row + 1 < last ? 2
                               : row < last   ? 1
                                              : 0) *
                                  stride,
                       out + kChannels * u);
      }
    }
  });
  return moved;
}

}  // namespace

GrayImage moveRows(const GrayImage& picture, const RowAlignment& alignment) {
  return move(picture, alignment);
}

ColourImage moveRows(const ColourImage& picture, const RowAlignment& alignment) {
  return move(picture, alignment);
}

}  // namespace softscope
