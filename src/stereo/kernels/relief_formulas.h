// src/stereo/kernels/relief_formulas.h: formulas of the relief that the last steps of the
// refinement return to its planes, for one pixel on the GPU or one SIMD register of pixels on the
// CPU.
//
// V: float, or a vector of floats; masks come from comparisons of V. Never contracted.
#pragma once

#include "core/hd.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Square of the returned relief, and variance of the planes' noise, for the sums of a window.
template <class V>
SOFTSCOPE_FORMULA void reliefAndNoise(V planes, V disparity, V sigma, float model_variance_px2,
                                      V* relief_sq, V* noise_sq) {
  const V relief = disparity - planes;
  const auto matched = relief == relief;
  *relief_sq = matched ? relief * relief : V{};
  *noise_sq = matched ? sigma * sigma - model_variance_px2 : V{};
}

/// Share of the returned relief that is kept, by sums over a window (Wiener).
template <class V>
SOFTSCOPE_FORMULA V reliefGain(V relief_sq, V noise_sq) {
  constexpr float kNoise = static_cast<float>(RefinementOptions::kReliefNoise);
  const V gain = 1.0f - kNoise * noise_sq / relief_sq;
  return gain > 0.0f ? gain : V{};  // also where both are zero
}

/// Relief that is kept: of the pixel's own the share `gain`, of the smooth one the rest.
template <class V>
SOFTSCOPE_FORMULA V keptRelief(V relief, V smooth, V gain) {
  return smooth + gain * (relief - smooth);
}

/// Variance of the planes' disparity with a share `gain` of the returned relief.
template <class V>
SOFTSCOPE_FORMULA V varianceWithRelief(V variance, V gain, float model_variance_px2) {
  constexpr float kNoise = static_cast<float>(RefinementOptions::kReliefNoise),
                  kTwice = static_cast<float>(2 * RefinementOptions::kReliefCovariance);
  return model_variance_px2 +
         (variance - model_variance_px2) * (1.0f + gain * (kTwice + gain * kNoise));
}

/// Share of an error that is alike over many windows which the relief's steps return: each returns
/// the share of evidence of the rest.
template <class V>
SOFTSCOPE_FORMULA V reliefResponse(V evidence_share) {
  const V left = 1.0f - evidence_share;
  V all = left;
  for (int i = 1; i < RefinementOptions::relief_steps; ++i) all = all * left;
  return 1.0f - all;
}

// Relief that is alike over many windows: docs/stereo.md (4c).
constexpr int kReliefSquarePx = 8;

/// Sums over the matched pixels of a square, or of many, weighted.
struct ReliefSquare {
  float relief, response, pixels;
};
SOFTSCOPE_FORMULA void addPixel(float planes, float disparity, float response,
                                ReliefSquare* square) {
  const float relief = disparity - planes;
  if (!(relief == relief)) return;
  square->relief += relief;
  square->response += response;
  square->pixels += 1;
}
SOFTSCOPE_FORMULA void addSquare(float weight, const ReliefSquare& more, ReliefSquare* sums) {
  sums->relief += weight * more.relief;
  sums->response += weight * more.response;
  sums->pixels += weight * more.pixels;
}
/// Weighted sum of the squares around one, along a column (dx = 0) or a row; `window` has
/// 2 reach + 1 weights. Squares: a raster of the CPU or of the GPU.
template <class Squares>
SOFTSCOPE_FORMULA ReliefSquare squaresAround(const Squares& squares, int x, int y, int dx, int dy,
                                             const float* window, int reach) {
  ReliefSquare sums{};
  for (int i = -reach; i <= reach; ++i)
    if (squares.contains(x + i * dx, y + i * dy))
      addSquare(window[i + reach], squares.at(x + i * dx, y + i * dy), &sums);
  return sums;
}
/// What the steps would have returned in the end.
SOFTSCOPE_FORMULA float smoothRelief(const ReliefSquare& sums) {
  constexpr float kLeast = static_cast<float>(RefinementOptions::kLeastResponse);
  const float least = kLeast * sums.pixels;
  const float response = sums.response > least ? sums.response : least;
  return response > 0 ? sums.relief / response : 0.0f;
}

inline int reliefSquares(int pixels) { return (pixels + kReliefSquarePx - 1) / kReliefSquarePx; }

}  // namespace softscope
