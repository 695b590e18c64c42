// src/stereo/kernels/light_formulas.h: formulas of brightness differences between the cameras, for
// the CPU and the GPU.
#pragma once

#include "core/hd.h"
#include "core/small_solve.h"

namespace softscope {

/// Low-pass brightness of the right camera minus that of the left, for
/// the same tissue: the cameras differ in offset, vignetting and gain.
struct LightDifference {
  double at_centre = 0, across = 0, down = 0;  // grey levels; at the right and the lower border
  double gain = 0;                             // grey levels per kBright

  static constexpr double kBright = 64;
  static constexpr int kTerms = 4;
};

/// Position among the image's columns or rows, -1 to 1.
template <class V>
SOFTSCOPE_FORMULA V fromCentre(V pixel, float size_px) {
  return pixel * (2 / size_px) - 1.0f;
}

/// The difference along one row, in single precision.
struct LightRow {
  float base, across, gain, width_px;
};
SOFTSCOPE_HD inline LightRow lightOfRow(const LightDifference& light, int v, int width_px,
                                        int height_px) {
  const float y = fromCentre(static_cast<float>(v), static_cast<float>(height_px));
  return {static_cast<float>(light.at_centre - light.gain + light.down * y),
          static_cast<float>(light.across),
          static_cast<float>(light.gain / LightDifference::kBright), static_cast<float>(width_px)};
}
/// At a pixel of the row, given the low-pass brightness of the left camera.
template <class V>
SOFTSCOPE_FORMULA V lightAt(const LightRow& row, V u, V slow_left) {
  return row.base + row.across * fromCentre(u, row.width_px) + row.gain * slow_left;
}

/// Robust least squares on every kStepPx-th pixel.
struct LightFit {
  static constexpr int kStepPx = 8;
  static constexpr int kParts = 8;          // of a row, summed separately
  static constexpr double kGray = 4;        // residual that quarters the weight of a sample …
  static constexpr double kFirstGray = 40;  // … and in the first round
  static constexpr double kRidge = 1e-3;    // in samples: weight of zero for each term

  /// Rounds of reweighting before a step of the refinement.
  SOFTSCOPE_HD static int rounds(int step) { return step == 0 ? 3 : 1; }
  SOFTSCOPE_HD static double tolerance(int step, int round) {
    return step == 0 && round == 0 ? kFirstGray : kGray;
  }
  SOFTSCOPE_HD static int samplesAlong(int size_px) { return size_px / kStepPx; }
  SOFTSCOPE_HD static int place(int sample) { return sample * kStepPx + kStepPx / 2; }
};

/// Normal equations.
struct LightSums {
  double normal[triangleSize(LightDifference::kTerms)] = {};
  double right[LightDifference::kTerms] = {};

  SOFTSCOPE_HD void add(const LightSums& other) {
    for (int i = 0; i < triangleSize(LightDifference::kTerms); ++i) normal[i] += other.normal[i];
    for (int i = 0; i < LightDifference::kTerms; ++i) right[i] += other.right[i];
  }
};

/// One part of a row of samples, from left to right. `disparity_px`: NaN if unmatched.
SOFTSCOPE_HD inline LightSums lightSumsOfPart(const float* slow_left, const float* slow_right,
                                              const float* disparity_px, int v, int part,
                                              int width_px, int height_px,
                                              const LightDifference& light, double tolerance_gray) {
  LightSums sums;
  const double y = fromCentre(static_cast<float>(v), static_cast<float>(height_px));
  const double before[] = {light.at_centre, light.across, light.down, light.gain};
  const int count = LightFit::samplesAlong(width_px), end = (part + 1) * count / LightFit::kParts;
  for (int i = part * count / LightFit::kParts; i < end; ++i) {
    const int u = LightFit::place(i);
    const float x = static_cast<float>(u) - disparity_px[u];
    if (!(x >= 0 && x < static_cast<float>(width_px - 1))) continue;  // NaN compares false
    const int x0 = static_cast<int>(x);
    const float t = x - static_cast<float>(x0);
    const float right = slow_right[x0] + t * (slow_right[x0 + 1] - slow_right[x0]);
    const double row[] = {1, fromCentre(static_cast<float>(u), static_cast<float>(width_px)), y,
                          slow_left[u] / LightDifference::kBright - 1};
    const double found = right - slow_left[u];
    double residual = found;
    for (int k = 0; k < LightDifference::kTerms; ++k) residual -= before[k] * row[k];
    const double q = 1 + residual * residual / (tolerance_gray * tolerance_gray), w = 1 / (q * q);
    for (int k = 0; k < LightDifference::kTerms; ++k) {
      for (int j = 0; j <= k; ++j) sums.normal[k * (k + 1) / 2 + j] += w * row[k] * row[j];
      sums.right[k] += w * row[k] * found;
    }
  }
  return sums;
}

SOFTSCOPE_HD inline LightDifference solveLight(LightSums sums) {
  for (int k = 0; k < LightDifference::kTerms; ++k)
    sums.normal[k * (k + 1) / 2 + k] += LightFit::kRidge;
  if (!factorSymmetric<LightDifference::kTerms>(sums.normal)) return LightDifference();
  solveSymmetric<LightDifference::kTerms>(sums.normal, sums.right);
  return {sums.right[0], sums.right[1], sums.right[2], sums.right[3]};
}

}  // namespace softscope
