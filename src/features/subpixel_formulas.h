// src/features/subpixel_formulas.h: formulas of the sub-pixel refinement, for the CPU and the GPU.
//
// Sums over a window run by rows, each from left to right, wherever nothing else is said: both
// sides then give the same bytes.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "features/kernels.h"
#include "features/matcher_options.h"

namespace softscope {

/// Neighbouring pixels' residuals are alike after smoothing, so a window holds less information
/// than its number of pixels; measured against true errors.
constexpr float kCorrelatedPixels = 4.0f;
constexpr float kLeastWindowShare = 0.6f;  // of the window's weight that isn't ignored
constexpr float kLeastContrastSq = 0.5f;   // variance of the window, gray levels²
constexpr float kLeastDeterminant = 1e-6f;
constexpr float kConvergedPx = 0.003f;
constexpr float kLargestSigmaPx = 1.5f;  // of any match; more is no place

/// Weight of each pixel of the window, by rows of kWindowLanes; `all` is their sum.
struct WindowWeights {
  float values[kLargestWindow * kWindowLanes];
  float all;
};
inline WindowWeights windowWeights(int radius_px) {
  WindowWeights window{};
  const float sigma = 0.8f * static_cast<float>(radius_px) + 0.5f;
  for (int y = -radius_px; y <= radius_px; ++y)
    for (int x = -radius_px; x <= radius_px; ++x) {
      const float weight = std::exp(-0.5f * static_cast<float>(x * x + y * y) / (sigma * sigma));
      window.values[(y + radius_px) * kWindowLanes + x + radius_px] = weight;
      window.all += weight;
    }
  return window;
}

/// One pixel of the 3 x 3 binomial filter: less noise, and bilinear samples that hardly depend on
/// the fraction. Sums of columns (1, 2, 1).
SOFTSCOPE_FORMULA float binomial(int left, int middle, int right) {
  return 0.0625f * static_cast<float>(left + 2 * middle + right);
}

/// Whether window and gradients lie inside the model image.
SOFTSCOPE_HD inline bool isInsideModel(int u, int v, int r, int width, int height) {
  return u - r - 1 >= 0 && v - r - 1 >= 0 && u + r + 1 < width && v + r + 1 < height;
}
/// The kernel reads kWindowLanes + 1 columns and one row more than the window.
SOFTSCOPE_HD inline bool isInsideLive(float centre_u, float centre_v, int r, int width,
                                      int height) {
  const float u = centre_u - static_cast<float>(r), v = centre_v - static_cast<float>(r);
  return u >= 0 && v >= 0 && u + kWindowLanes + 1 < static_cast<float>(width) &&
         v + static_cast<float>(2 * r + 2) < static_cast<float>(height);
}

/// Weighted means of a window, and how its gradients follow its contrast.
struct WindowMoments {
  float mean, gradient_u, gradient_v;
  float square, along_u, along_v;  // of the contrast with itself and with the gradients
};
/// A gradient without the window's mean and contrast.
template <class V>
SOFTSCOPE_FORMULA V projectedGradient(V gradient, V mean, V contrast, V along, V square) {
  return gradient - mean - contrast * along / square;
}

/// Weighted products of the projected gradients; (row, column).
struct WindowMatrix {
  float uu, uv, vu, vv;
};
SOFTSCOPE_HD inline float determinantOf(const WindowMatrix& m) { return m.uu * m.vv - m.vu * m.uv; }
SOFTSCOPE_HD inline WindowMatrix inverseOf(const WindowMatrix& m) {
  const float scale = 1 / determinantOf(m);
  return {m.vv * scale, -m.uv * scale, -m.vu * scale, m.uu * scale};
}

/// Bilinear sample.
SOFTSCOPE_FORMULA float bilinear(float upper_left, float upper_right, float lower_left,
                                 float lower_right, float across, float down) {
  const float above = upper_left + across * (upper_right - upper_left);
  const float below = lower_left + across * (lower_right - lower_left);
  return above + down * (below - above);
}

/// A template on its way through the live image.
struct WindowSearch {
  float u, v;              // of the window's middle
  float start_u, start_v;  // where it began
  WindowMatrix inverse;    // of the information
  float contrast_sq;
  float weight_sq;  // sum of squared weights: 1 / independent pixels
};
enum class SearchStep { kGoesOn, kConverged, kRefused };

/// One step of Gauss-Newton.
SOFTSCOPE_HD inline SearchStep takeStep(const WindowSums& sums, float farthest_px, int radius_px,
                                        int width, int height, WindowSearch* search) {
  const float gain = sums.along_contrast / search->contrast_sq;
  if (!(gain > 0.1f && gain < 10.0f)) return SearchStep::kRefused;
  const WindowMatrix& inverse = search->inverse;
  const float u = (inverse.uu * sums.along_u + inverse.uv * sums.along_v) / gain;
  const float v = (inverse.vu * sums.along_u + inverse.vv * sums.along_v) / gain;
  search->u -= u;
  search->v -= v;
  const float moved_u = search->u - search->start_u, moved_v = search->v - search->start_v;
  if (!(std::sqrt(moved_u * moved_u + moved_v * moved_v) <= farthest_px) ||
      !isInsideLive(search->u, search->v, radius_px, width, height))
    return SearchStep::kRefused;
  return std::sqrt(u * u + v * v) < kConvergedPx ? SearchStep::kConverged : SearchStep::kGoesOn;
}

/// Fit of a window at its place.
struct WindowVerdict {
  bool accepted;
  float similarity, sigma_px;
};
/// Standard error from what the window leaves unexplained.
SOFTSCOPE_HD inline WindowVerdict classifyWindow(const WindowSums& sums, const WindowSearch& search,
                                                 float floor_px, float min_similarity) {
  const float variance = sums.square - sums.mean * sums.mean;
  if (!(variance > 0)) return {false, 0, 0};
  const float gain = sums.along_contrast / search.contrast_sq;
  const float similarity = sums.along_contrast / std::sqrt(search.contrast_sq * variance);
  const float unexplained_share = 1 - similarity * similarity;
  const float unexplained = variance * (0.0f < unexplained_share ? unexplained_share : 0.0f);
  const float half_trace = 0.5f * (search.inverse.uu + search.inverse.vv);
  const float discriminant = half_trace * half_trace - determinantOf(search.inverse);
  const float worst = half_trace + std::sqrt(0.0f < discriminant ? discriminant : 0.0f);
  const float sigma_px =
      std::sqrt(kCorrelatedPixels * search.weight_sq * unexplained * worst / (gain * gain) +
                floor_px * floor_px);
  return {similarity >= min_similarity && sigma_px <= kLargestSigmaPx, similarity, sigma_px};
}

/// Root of the sum of two squares, rounded once.
SOFTSCOPE_HD inline float quadratureSum(float a, float b) {
  const double x = a, y = b;
  return static_cast<float>(std::sqrt(x * x + y * y));
}

/// Whether the window of the model's first looks decides: it held, and is sure enough.
SOFTSCOPE_HD inline bool anchorDecides(bool held, float sigma_px, float max_sigma_px) {
  return held && sigma_px <= max_sigma_px;
}
/// Else: whether it is still better than the window of the present looks.
SOFTSCOPE_HD inline bool anchorIsBetter(bool held, float sigma_px, bool seen,
                                        float present_sigma_px) {
  return held && (!seen || sigma_px < present_sigma_px);
}

}  // namespace softscope
