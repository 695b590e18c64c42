// src/stereo/kernels/smoothing_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/smoothing_kernels.h"

#include "core/kernel_list.h"
#include "stereo/kernels/patch_formulas.h"
#include "stereo/kernels/simd.h"

namespace softscope {
namespace {

void smoothCell(const SmoothingCell& cell, int v, int begin, int end, float* disparity_px,
                float* sigma_px) {
  const Floats nothing{}, last = broadcast(static_cast<float>(end));
  for (int first = begin; first < end; first += kFloatLanes) {
    const Floats u = laneNumbers() + static_cast<float>(first);
    const Floats right = alongCells(u, cell.size) - static_cast<float>(cell.number);
    const Floats d = loadFloats(disparity_px + first), sigma = loadFloats(sigma_px + first);
    const Floats variance = sigma * sigma;
    Floats weight[4], variances[4], predictions[4];
    for (int k = 0; k < 4; ++k) {
      const Floats x = (u - cell.u0[k]) * cell.scale,
                   y = nothing + (static_cast<float>(v) - cell.v0[k]) * cell.scale;
      Floats c[6];
      for (int i = 0; i < 6; ++i) c[i] = broadcast(cell.c[i][k]);
      const Floats predicted = patchValue<Floats>(c, x, y);
      const Floats share = cell.share_left[k] * (1.0f - right) + cell.share_right[k] * right;
      weight[k] = patchWeight<Floats>(share, d - predicted, broadcast(cell.variance[k]), variance);
      variances[k] = weight[k] * cell.variance[k];
      predictions[k] = weight[k] * predicted;
    }
    const Floats weights = sumFour(weight);
    const Floats drawn = shareOfPixel<Floats>(variance, weights, sumFour(variances));
    const Ints holds = (d == d) & (sigma > nothing) & (weights > nothing) & (u < last);
    store(disparity_px + first,
          holds ? drawnDisparity<Floats>(d, drawn, weights, sumFour(predictions)) : d);
    store(sigma_px + first, holds ? sigma * squareRoot(drawn) : sigma);
  }
}

}  // namespace

extern const SmoothingKernels SOFTSCOPE_NAME(smoothingKernels, SOFTSCOPE_SIMD_SET);
const SmoothingKernels SOFTSCOPE_NAME(smoothingKernels, SOFTSCOPE_SIMD_SET) = {smoothCell};

}  // namespace softscope
