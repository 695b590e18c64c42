// src/stereo/kernels/filter_formulas.h: formulas of disparity filters, pyramid levels, depth and
// erosion, for the CPU and the GPU.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/hd.h"

namespace softscope {

SOFTSCOPE_FORMULA float absoluteOf(float x) { return x < 0.0f ? -x : x; }
SOFTSCOPE_FORMULA bool isNumber(float x) { return x == x; }
SOFTSCOPE_FORMULA int nearestInteger(float x) {
  return static_cast<int>(x < 0.0f ? x - 0.5f : x + 0.5f);
}

/// Whether the right image confirms disparity `d` of column u. `back`:
/// disparity of the right image at column u - d; -1 if unmatched.
SOFTSCOPE_FORMULA bool confirmsDisparity(int d, int back, int tolerance_px) {
  const int apart = back - d;
  return back >= 0 && (apart < 0 ? -apart : apart) <= tolerance_px;
}

/// k-th of `gap` values between two measured ones.
SOFTSCOPE_FORMULA float gapValue(float before, float after, int k, int gap) {
  return before + (after - before) * static_cast<float>(k) / static_cast<float>(gap + 1);
}

/// Whether there is a step between two measured pixels `apart` pixels from each other.
SOFTSCOPE_FORMULA bool isDepthStep(float a, float b, int apart, float step, float slope) {
  return absoluteOf(a - b) > step + slope * static_cast<float>(apart - 1);
}

constexpr float kRimContrast = 0.13f;  // share of the brightness by which two surfaces differ

/// Whether a pixel was measured by the rim of the surface beside it, given the centre (x, y) of its
/// evidence: farther away than `rim_px`, of another brightness on its other side, and one of the
/// `reach` pixels away from it is unmeasured. isMeasured(x, y) and grayAt(x, y) are relative to the
/// pixel, as x and y are.
template <class IsMeasured, class GrayAt>
SOFTSCOPE_FORMULA bool isBeyondEvidence(float x, float y, float rim_px, int reach,
                                        const IsMeasured& isMeasured, const GrayAt& grayAt) {
  if (!(x * x + y * y > rim_px * rim_px)) return false;
  const float across = absoluteOf(x), along = absoluteOf(y);
  const float longer = across > along ? across : along;
  const float farthest = static_cast<float>(reach);
  const float twice = longer > farthest ? 2 * farthest / longer : 2.0f;
  const float here = grayAt(0, 0),
              there = grayAt(nearestInteger(twice * x), nearestInteger(twice * y));
  if (!(absoluteOf(here - there) > kRimContrast * (here > there ? here : there))) return false;
  for (int i = 1; i <= reach; ++i) {
    const float away = -static_cast<float>(i) / longer;
    if (!isMeasured(nearestInteger(away * x), nearestInteger(away * y))) return true;
  }
  return false;
}

constexpr int kUnevenSpacingPx = 2;  // between the pixels of a window that are counted
constexpr float kApartPx = 0.75f;
constexpr float kMostApart = 0.35f;  // of the measured pixels
/// Whether a pixel of a window is measured apart from its centre.
SOFTSCOPE_FORMULA bool isApart(float disparity, float centre) {
  return absoluteOf(disparity - centre) > kApartPx;
}
/// Windows with little texture take a ramp from one surface to another, as the prior has it, for
/// tissue.
SOFTSCOPE_FORMULA bool isUneven(int apart, int measured) {
  return static_cast<float>(apart) > kMostApart * static_cast<float>(measured);
}

constexpr int kBehindRimPx = 13;  // from a rim to the surface behind it, at most: a window's width
constexpr float kRimStepPx = 3;   // which is farther by more
constexpr int kRimReachPx = 4;    // so far from a rim windows may have measured the near surface
constexpr float kNoRim = 3e38f;
/// Disparity of a rim: of a pixel beside which the next measured one, in its row or column, is of a
/// farther surface; otherwise kNoRim. disparityAt(x, y) is relative to the pixel, NaN outside.
template <class DisparityAt>
SOFTSCOPE_FORMULA float rimDisparity(const DisparityAt& disparityAt) {
  const float here = disparityAt(0, 0);
  if (!isNumber(here)) return kNoRim;
  for (int side = 0; side < 4; ++side) {
    const int along = side % 2 == 0 ? 1 : -1, x = side < 2 ? along : 0, y = side < 2 ? 0 : along;
    for (int i = 1; i <= kBehindRimPx; ++i) {
      const float behind = disparityAt(i * x, i * y);
      if (!isNumber(behind)) continue;
      if (here - behind > kRimStepPx) return here;
      break;
    }
  }
  return kNoRim;
}
/// Whether a pixel is of the near surface, given the least disparity of a rim within its reach.
SOFTSCOPE_FORMULA bool isAtRim(float disparity, float least_rim) {
  return disparity > least_rim - kRimStepPx;
}
/// Such a pixel may be a step off.
SOFTSCOPE_FORMULA float sigmaAtRim(float sigma) { return sigma < kRimStepPx ? kRimStepPx : sigma; }

constexpr int kFringeReachPx = 8;            // of windows, from what they do not measure
constexpr int kWithinPx = 9, kBeyondPx = 4;  // clear of the fringe on both sides
constexpr float kFringeContrast = 0.2f;      // share of the brightness by which two surfaces differ
/// Whether a measured pixel looks like the unmeasured ones beside it, in its row or column, and not
/// like the measured ones on its other side. disparityAt(x, y) and grayAt(x, y) are relative to the
/// pixel, NaN outside.
template <class DisparityAt, class GrayAt>
SOFTSCOPE_FORMULA bool isFringe(const DisparityAt& disparityAt, const GrayAt& grayAt) {
  for (int side = 0; side < 4; ++side) {
    const int along = side % 2 == 0 ? 1 : -1, x = side < 2 ? along : 0, y = side < 2 ? 0 : along;
    int end = 1;
    while (end <= kFringeReachPx && isNumber(disparityAt(-end * x, -end * y))) ++end;
    if (end > kFringeReachPx || !isNumber(disparityAt(kWithinPx * x, kWithinPx * y))) continue;
    const int beyond = end + kBeyondPx;
    const float here = grayAt(0, 0), within = grayAt(kWithinPx * x, kWithinPx * y),
                out = grayAt(-beyond * x, -beyond * y);
    if (absoluteOf(out - within) > kFringeContrast * (out > within ? out : within) &&
        2 * absoluteOf(here - out) < absoluteOf(here - within))
      return true;
  }
  return false;
}

/// Mean of the 3 x 3 pixels around (u, v), the first and last rows and columns repeated.
template <class PixelAt>
SOFTSCOPE_FORMULA float meanAround(int u, int v, int width, int height, const PixelAt& pixelAt) {
  const int left = u > 0 ? u - 1 : 0, right = u + 1 < width ? u + 1 : u;
  const int above = v > 0 ? v - 1 : 0, below = v + 1 < height ? v + 1 : v;
  int sum = 0;
  for (const int y : {above, v, below}) sum += pixelAt(left, y) + pixelAt(u, y) + pixelAt(right, y);
  return static_cast<float>(sum) / 9;
}

constexpr float kOneSurfacePx = 1.5f;  // four pixels with larger differences are on two surfaces

/// Position of a pixel of the full size in the half size.
struct HalfPosition {
  int u0, v0;
  float fu, fv;
};
SOFTSCOPE_FORMULA HalfPosition halfPosition(int u, int v) {
  const float x = 0.5f * static_cast<float>(u) - 0.25f, y = 0.5f * static_cast<float>(v) - 0.25f;
  const float x0 = x > 0.0f ? x : 0.0f, y0 = y > 0.0f ? y : 0.0f;
  const int u0 = static_cast<int>(x0), v0 = static_cast<int>(y0);
  return {u0, v0, x0 - static_cast<float>(u0), y0 - static_cast<float>(v0)};
}

/// Four neighbours: (u0, v0), (u1, v0), (u0, v1), (u1, v1), the last column and row repeated.
struct FourPixels {
  float a, b, c, d;
};
SOFTSCOPE_FORMULA FourPixels fourPixels(const float* values, int width, int height, int u0,
                                        int v0) {
  const int u1 = u0 + 1 < width ? u0 + 1 : width - 1, v1 = v0 + 1 < height ? v0 + 1 : height - 1;
  const float *upper = values + static_cast<std::ptrdiff_t>(v0) * width,
              *lower = values + static_cast<std::ptrdiff_t>(v1) * width;
  return {upper[u0], upper[u1], lower[u0], lower[u1]};
}
/// NaN with an unmeasured pixel.
SOFTSCOPE_FORMULA float bilinear(const FourPixels& p, float fu, float fv) {
  return (1 - fv) * ((1 - fu) * p.a + fu * p.b) + fv * ((1 - fu) * p.c + fu * p.d);
}
/// Whether all four are measured, on one surface.
SOFTSCOPE_FORMULA bool isOneSurface(const FourPixels& p) {
  if (!(isNumber(p.a) && isNumber(p.b) && isNumber(p.c) && isNumber(p.d))) return false;
  float low = p.a, high = p.a;
  for (const float x : {p.b, p.c, p.d}) {
    low = x < low ? x : low;
    high = x > high ? x : high;
  }
  return high - low <= kOneSurfacePx;
}

struct DepthPixel {
  float depth_mm, sigma_mm;
};
/// `d` > 0: disparity with the rig's offset. `scale` = fx * baseline.
SOFTSCOPE_FORMULA DepthPixel depthOfDisparity(double d, float sigma_px, double scale) {
  const double z = scale / d;
  return {static_cast<float>(z), static_cast<float>(z * z / scale * sigma_px)};
}

}  // namespace softscope
