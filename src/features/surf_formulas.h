// src/features/surf_formulas.h: formulas of dense SURF, for the CPU and the GPU.
#pragma once

#include <cstdint>

#include "core/hd.h"
#include "features/dense_surf.h"
#include "features/kernels.h"

namespace softscope {

constexpr int kSurfCells = 4;  // a side
constexpr int kSurfSums = 4;   // dx, |dx|, dy, |dy|

/// Common parameters of all descriptors of an image.
struct SurfRules {
  int reach;           // grid squares per side of a cell
  int first_px;        // pixel of node 0, both axes
  int least_valid;     // wavelets
  float gray_per_sum;  // mean difference of the halves' gray levels, from the sum of |dx| + |dy|
  float min_contrast_gray;
};
inline SurfRules surfRules(const DenseSurfOptions& options) {
  const int side = kSurfCells * options.cell_px;
  const double half_wavelet = 0.5 * options.kWaveletPx * options.kWaveletPx;
  // Wavelet u is between the pixels u - 1 and u, so that the centre of the cells is a pixel.
  return {options.cell_px / options.kGridPx, kSurfCells / 2 * options.cell_px - 1,
          static_cast<int>((1 - options.kMaxInvalidShare) * side * side),
          static_cast<float>(1 / (half_wavelet * 2 * side * side)),
          static_cast<float>(options.kMinContrastGray)};
}
/// Nodes along a side of the image; 0 if it is shorter than one descriptor.
inline int surfNodes(int side_px, const DenseSurfOptions& options) {
  const int cells_px = kSurfCells * options.cell_px;
  if (side_px < (cells_px > options.kWaveletPx ? cells_px : options.kWaveletPx)) return 0;
  return side_px / options.kGridPx - kSurfCells * (options.cell_px / options.kGridPx) + 1;
}

/// Second half minus first half of a wavelet.
template <class Value>
SOFTSCOPE_FORMULA Value haarResponse(const Value& all, const Value& first_half) {
  return all - 2 * first_half;
}

/// Squared length of a descriptor: eight partial sums, added by a fixed tree.
SOFTSCOPE_FORMULA float sumOfLanes(const float (&lanes)[8]) {
  return ((lanes[0] + lanes[4]) + (lanes[1] + lanes[5])) +
         ((lanes[2] + lanes[6]) + (lanes[3] + lanes[7]));
}
SOFTSCOPE_FORMULA float descriptorScale(float length) {
  return length > 0 ? kDescriptorUnit / length : 0.0f;
}
SOFTSCOPE_FORMULA std::uint8_t descriptorByte(float value, float scale) {
  const float scaled = value * scale;
  const float clamped = scaled < -128 ? -128.0f : (scaled > 127 ? 127.0f : scaled);
  return static_cast<std::uint8_t>(static_cast<int>(clamped + 128.5f));
}

/// Whether a node is valid for matching.
SOFTSCOPE_HD inline bool isDistinct(int valid_wavelets, float contrast_gray,
                                    const SurfRules& rules) {
  return valid_wavelets >= rules.least_valid && contrast_gray >= rules.min_contrast_gray;
}

}  // namespace softscope
