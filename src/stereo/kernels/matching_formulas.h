// src/stereo/kernels/matching_formulas.h: formulas of gradients, support points, prior and dense
// matching, for the CPU and the GPU.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "stereo/kernels/matching_kernels.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

constexpr int kCostDifferences = 50;  // absolute differences summed in one matching cost
constexpr float kNoSupport = -1;      // disparity of a grid pixel without a support point

SOFTSCOPE_FORMULA int clampByte(int x) { return x < 0 ? 0 : (x > 255 ? 255 : x); }

/// Both Sobel responses of the middle one of three rows at column
/// u, packed as in GradientView. u - 1 and u + 1 are readable.
SOFTSCOPE_FORMULA std::uint16_t packedGradient(const std::uint8_t* above,
                                               const std::uint8_t* middle,
                                               const std::uint8_t* below, int before, int u,
                                               int after, int gain_q8) {
  const int right = above[after] + 2 * middle[after] + below[after];
  const int left = above[before] + 2 * middle[before] + below[before];
  const int bottom = below[before] + 2 * below[u] + below[after];
  const int top = above[before] + 2 * above[u] + above[after];
  const int du = clampByte(128 + ((right - left) * gain_q8 + 128) / 256);
  const int dv = clampByte(128 + ((bottom - top) * gain_q8 + 128) / 256);
  return static_cast<std::uint16_t>(du + 256 * dv);
}

inline int gainQ8(double gradient_gain) {
  return static_cast<int>(std::lround(gradient_gain * 256));
}

/// The support window: every second pixel of nine by nine.
// The range of disparities for all rows of the grid, from the points of some rows.
constexpr int kRangeRows = 4;        // every fourth row is searched over the whole range
constexpr int kFewestForRange = 50;  // points, to determine the range
constexpr int kNearDisparityPx = 2;  // points with disparities this close …
constexpr int kFewestNear = 3;       // … and this many form a surface
constexpr int kBeyondRangePx = 16;   // on either side

constexpr int kSupportSide = kSupportMargin + 1;
constexpr int kSupportPixels = kSupportSide * kSupportSide;
SOFTSCOPE_FORMULA int supportOffset(int index) { return 2 * index - kSupportMargin; }

/// |gradient| of one pixel.
SOFTSCOPE_FORMULA int supportTexture(int packed) {
  const int du = packed % 256 - 128, dv = packed / 256 - 128;
  return (du < 0 ? -du : du) + (dv < 0 ? -dv : dv);
}
/// Sum over the support window around `centre`.
SOFTSCOPE_FORMULA int supportTextureSum(const std::uint16_t* centre, int stride) {
  int sum = 0;
  for (int y = 0; y < kSupportSide; ++y)
    for (int x = 0; x < kSupportSide; ++x)
      sum += supportTexture(centre[supportOffset(y) * stride + supportOffset(x)]);
  return sum;
}

/// Number of disparities from `minimum` on, at most `count`, with
/// a cost at column u: the support window is inside both images.
SOFTSCOPE_FORMULA int supportCountAt(int u, int width, int minimum, int count) {
  const int largest =
      (u < width - kSupportNarrowest ? u : width - kSupportNarrowest) - kSupportMargin;
  const int fitting = largest - minimum + 1;
  return fitting < 0 ? 0 : (fitting > count ? count : fitting);
}

/// Offset of the minimum of the parabola through three costs, within half a pixel.
SOFTSCOPE_FORMULA float parabolaOffset(int before, int at, int after) {
  const int curvature = before - 2 * at + after;
  if (curvature <= 0) return 0;
  return 0.5f * static_cast<float>(before - after) / static_cast<float>(curvature);
}

/// Cost of the distance of a disparity from the prior: a parabola up to a plateau.
struct PriorCost {
  int band_px8;  // half width of the band of allowed disparities
  int slope;     // cost of (1 px)^2, at most kLargestPriorSlope
  int cap;       // the plateau
};

inline PriorCost priorCostOf(const ElasOptions& elas) {
  const double cap = elas.prior_weight * kCostDifferences;
  // -log(gamma + exp(-t^2 / 2 sigma^2)) is flat beyond about 1.5 sigma.
  const double slope = cap / std::pow(1.5 * elas.prior_sigma_px, 2);
  PriorCost cost{};
  cost.band_px8 = static_cast<int>(std::lround(8 * 3 * elas.prior_sigma_px));
  cost.slope = std::clamp(static_cast<int>(std::lround(slope)), 0, kLargestPriorSlope);
  cost.cap = std::min(static_cast<int>(std::lround(cap)), cost.slope * 14);
  return cost;
}

/// |disparity - prior| in 1/8 px, in 16 bits as in the SIMD loop.
SOFTSCOPE_FORMULA int priorDistancePx8(int disparity_px, std::int16_t prior_px8) {
  const auto away = static_cast<std::int16_t>(disparity_px * 8 - prior_px8);
  const auto back = static_cast<std::int16_t>(-away);
  return away > back ? away : back;
}
SOFTSCOPE_FORMULA int costOfDistance(const PriorCost& cost, int distance_px8) {
  const int t4 = (distance_px8 < 31 ? distance_px8 : 31) >> 1;  // quarter pixels
  const int parabola = (t4 * t4 * cost.slope) >> 4;
  return parabola < cost.cap ? parabola : cost.cap;
}

/// Whole disparities in the band around the priors of a tile, within the search range.
struct DisparityBand {
  int first, last;
};
SOFTSCOPE_FORMULA DisparityBand bandAround(int low_px8, int high_px8, int band_px8, int minimum,
                                           int maximum) {
  const int first = (low_px8 - band_px8) / 8, last = (high_px8 + band_px8) / 8 + 1;
  return {first > minimum ? first : minimum, last < maximum ? last : maximum};
}

}  // namespace softscope
