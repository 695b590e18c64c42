// src/fusion/fusion_weights.h: weight of a measurement relative to the model.
#pragma once

#include <cmath>

#include "core/hd.h"
#include "fusion/fusion_options.h"

namespace softscope {

/// Inverse-variance weight of a depth, 1 at the reference: docs/fusion.md (F5). mm.
SOFTSCOPE_HD inline float depthWeight(float sigma_mm, float reference_sigma_mm, float largest) {
  if (!(reference_sigma_mm > 0)) return 1;
  const float ratio = reference_sigma_mm / sigma_mm;
  const float weight = ratio * ratio;
  return weight < largest ? weight : largest;
}

/// 0 from tau on; below it 1, or a smooth decay: (F6). mm.
SOFTSCOPE_HD inline float truncationWeight(float ahead_mm, float truncation_mm, bool soft) {
  const float share = ahead_mm / truncation_mm, rest = 1 - share * share;
  if (!(rest > 0)) return 0;
  return soft ? rest * rest : 1.0f;
}

/// Factor of a measurement by the distance to the nearest node, in half node spacings: (F7).
SOFTSCOPE_HD inline float nodeWeight(NodeTrust trust, float half_spacings) {
  const float share = half_spacings < 1 ? half_spacings : 1.0f;
  if (trust == NodeTrust::kPaper) return share;
  return 1;
}

/// Weight of a point after one warp: (F7). `noise` is the variance of the
/// warp at half a spacing from all nodes, in units of the reference variance.
SOFTSCOPE_HD inline float weightAfterWarp(float weight, float half_spacings, float noise) {
  const float share = half_spacings < 1 ? half_spacings : 1.0f;
  return weight / (1 + weight * noise * share * share);
}

/// (F22): upper limit of the weight from the innovation around the point. mm².
SOFTSCOPE_HD inline float weightAfterInnovation(float weight, float excess_mm2,
                                                float reference_sigma_mm) {
  const float limit = reference_sigma_mm * reference_sigma_mm;
  return weight * excess_mm2 > limit ? limit / excess_mm2 : weight;
}

/// (F23): for a displaced region, a large difference is not an outlier.
SOFTSCOPE_HD inline float widenedTruncation(float truncation_mm, float difference_mm2) {
  constexpr float kTukey = 4.685f;  // standard deviations: 95 % efficient on Gaussian errors
  const float wide_mm = kTukey * std::sqrt(difference_mm2);
  return wide_mm > truncation_mm ? wide_mm : truncation_mm;
}

/// Share of the new value in the running average: (F8).
SOFTSCOPE_HD inline float averagingGain(float weight, float measurement_weight) {
  return measurement_weight > 0 ? measurement_weight / (weight + measurement_weight) : 0.0f;
}

/// (F10): weight after a contradiction; 0 = the point is removed.
SOFTSCOPE_HD inline float contradictedWeight(float weight, float measurement_weight, float loss) {
  const float share = loss * measurement_weight, rest = (1 - share) * weight - 0.5f * share;
  return rest > 0 ? rest : 0.0f;
}

/// (F9).
SOFTSCOPE_HD inline float grownWeight(float weight, float measurement_weight, float largest) {
  const float sum = weight + measurement_weight;
  return sum < largest ? sum : largest;
}

}  // namespace softscope
