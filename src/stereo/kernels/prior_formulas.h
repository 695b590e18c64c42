// src/stereo/kernels/prior_formulas.h: formulas of the disparity prior between rows of support
// points, for the CPU and the GPU.
#pragma once

#include <cstdint>

#include "core/hd.h"

namespace softscope {

/// A disparity interpolated in a row of support points, and the distance of its points.
struct PriorEvidence {
  float disparity_px;
  float beside_px;  // columns: the harmonic mean of those to both points
  float away_px;    // rows
};

/// Between the points at columns `last` and `next`, of disparities `from`
/// and `to`; last = -1 or next = width without a point on that side.
SOFTSCOPE_FORMULA PriorEvidence priorBetween(int u, int last, int next, int width, float from,
                                             float to) {
  const bool has_last = last >= 0, has_next = next < width;
  const float before = static_cast<float>(u - last), after = static_cast<float>(next - u);
  if (!has_last) return {to, 2 * after, 0};
  if (!has_next) return {from, 2 * before, 0};
  const float slope = (to - from) / static_cast<float>(next - last);
  return {from + slope * before, 2 * before * after / (before + after), 0};
}

/// Value of a row, or of the previous row, `step` rows away, if its points are nearer.
SOFTSCOPE_FORMULA PriorEvidence nearerEvidence(const PriorEvidence& own,
                                               const PriorEvidence& before, float step) {
  if (before.beside_px + before.away_px + step < own.beside_px)
    return {before.disparity_px, before.beside_px, before.away_px + step};
  return {own.disparity_px, own.beside_px, 0};
}

/// Linear across rows if the points above and below are equally far to the side.
SOFTSCOPE_FORMULA float priorBetweenRows(const PriorEvidence& above, const PriorEvidence& below,
                                         float rows_above, float rows_below) {
  const float beside_both = below.beside_px < above.beside_px ? below.beside_px : above.beside_px;
  const float to_above = rows_above + above.away_px + above.beside_px - beside_both;
  const float to_below = rows_below + below.away_px + below.beside_px - beside_both;
  return (above.disparity_px * to_below + below.disparity_px * to_above) / (to_above + to_below);
}

SOFTSCOPE_FORMULA std::int16_t inEighths(float disparity_px) {
  return static_cast<std::int16_t>(static_cast<int>(8 * disparity_px + 0.5f));
}

}  // namespace softscope
