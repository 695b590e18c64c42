// src/stereo/kernels/patch_formulas.h: formulas of a pixel between four patches, for one pixel on
// the GPU or one SIMD register of pixels on the CPU.
//
// V: float, or a vector of floats. Never contracted.
#pragma once

#include "core/hd.h"

namespace softscope {

/// Standard errors at which a neighbour counts a quarter, squared.
constexpr float kPatchAgreeSq = 2.5f * 2.5f;

/// Position of a pixel among the centres of the blocks, along one axis.
struct CellPosition {
  int cell;        // the block whose centre is at or before the pixel; -1 before the first
  float fraction;  // of the way to the next
};
template <class V>
SOFTSCOPE_FORMULA V alongCells(V pixel, int size) {
  return (pixel + 0.5f) / static_cast<float>(size) - 0.5f;
}
SOFTSCOPE_FORMULA CellPosition cellPosition(int pixel, int size) {
  const float x = alongCells(static_cast<float>(pixel), size);
  const int cell = x < 0 ? -1 : static_cast<int>(x);
  return {cell, x - static_cast<float>(cell)};
}

template <class V>
SOFTSCOPE_FORMULA auto sumFour(const V& x) {
  return (x[0] + x[2]) + (x[1] + x[3]);
}

/// What one patch predicts at (x, y), in its windows from its origin.
template <class V>
SOFTSCOPE_FORMULA V patchValue(const V (&c)[6], const V& x, const V& y) {
  return c[0] + x * (c[1] + x * c[3] + y * c[4]) + y * (c[2] + y * c[5]);
}
/// Weight of a patch: its share of the pixel, less where the pixel disagrees.
template <class V, class P>
SOFTSCOPE_FORMULA V patchWeight(const V& share, const V& apart, const V& variance,
                                const P& pixel_variance) {
  const V q = 1.0f + apart * apart / (kPatchAgreeSq * (variance + pixel_variance));
  return share / (q * q);
}

/// Share of its variance that a pixel keeps which is drawn to the weighted mean of its patches: as
/// sure of them as it agrees with them. `weights` > 0; the sums are over the patches' weight *
/// variance and weight * predicted disparity.
template <class V>
SOFTSCOPE_FORMULA V shareOfPixel(V variance, V weights, V variances) {
  const V patch_variance = variances / weights / (weights < 1.0f ? weights : V{} + 1.0f);
  return patch_variance / (patch_variance + variance);
}
template <class V>
SOFTSCOPE_FORMULA V drawnDisparity(V disparity_px, V share, V weights, V predictions) {
  return disparity_px + (1.0f - share) * (predictions / weights - disparity_px);
}

}  // namespace softscope
