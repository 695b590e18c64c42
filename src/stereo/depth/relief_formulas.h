// src/stereo/depth/relief_formulas.h: relief that windows level out, pixel by pixel, for the CPU
// and the GPU.
#pragma once

#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

// Integer sums: the same in any order of addition.

/// A value and whether it is measured, in one number, of which sums over windows are those of both:
/// 32 bits are enough for each.
SOFTSCOPE_HD inline std::uint64_t reliefPair(std::uint32_t value) {
  return std::uint64_t{value} << 32 | 1;
}
SOFTSCOPE_HD inline std::uint32_t reliefValue(std::uint64_t pair) {
  return static_cast<std::uint32_t>(pair >> 32);
}
SOFTSCOPE_HD inline std::uint32_t reliefCount(std::uint64_t pair) {
  return static_cast<std::uint32_t>(pair);
}

constexpr int kSmoothedReach = 2 * RefinementOptions::radius_px;  // two windows in sequence
constexpr float kStepsPerPx = 1024;    // of disparity: 625 times 3355 px fit
constexpr float kStepsPerPx2 = 65536;  // of squared bends …
constexpr float kLargestBendPx2 = 50;  // … 625 of which fit
constexpr std::uint32_t kReliefEdge =
    static_cast<std::uint32_t>(StereoOptions::edge_step_px * kStepsPerPx);

/// The nearest whole number of one that is not negative, as std::lround(), which is a call.
template <class Real>
SOFTSCOPE_HD inline std::uint32_t roundedSteps(Real x) {
  const auto whole = static_cast<std::uint32_t>(x);
  return whole + (x - static_cast<Real>(whole) >= Real(0.5) ? 1 : 0);
}

/// Disparity of a depth in steps; 0 where it is not measured. `scale`: focal length times baseline.
SOFTSCOPE_HD inline std::uint32_t disparitySteps(float depth_mm, float scale) {
  constexpr float kLargest = static_cast<float>(StereoOptions::kLargestDisparityPx);
  if (!(depth_mm > 0)) return 0;
  const float disparity_px = scale / depth_mm;
  return roundedSteps(kStepsPerPx * (disparity_px < kLargest ? disparity_px : kLargest));
}

/// Whether windows end between two measured pixels.
SOFTSCOPE_HD inline bool isReliefStep(std::uint32_t a, std::uint32_t b) {
  return (a > b ? a - b : b - a) > kReliefEdge;
}

/// Squared distance of a disparity from the mean of its window.
SOFTSCOPE_HD inline std::uint64_t bendPair(std::uint32_t steps, std::uint64_t window) {
  const std::uint32_t count = reliefCount(window) > 1 ? reliefCount(window) : 1;
  const double bend_px = (steps - static_cast<double>(reliefValue(window)) / count) / kStepsPerPx;
  const double square = bend_px * bend_px;
  return reliefPair(
      roundedSteps(kStepsPerPx2 * (square < kLargestBendPx2 ? square : kLargestBendPx2)));
}

/// Root of the mean of such squares over a window.
SOFTSCOPE_HD inline float reliefErrorOf(std::uint64_t window) {
  return std::sqrt(static_cast<float>(reliefValue(window)) /
                   (kStepsPerPx2 * static_cast<float>(reliefCount(window))));
}

/// Whether both sides of a window reach as far as the shorter one: a plane is then the mean of its
/// window in its middle.
enum class ReliefSides { kBoth, kEven };

}  // namespace softscope
