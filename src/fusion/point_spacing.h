// src/fusion/point_spacing.h: point spacing as a function of depth.
#pragma once

#include "core/hd.h"
#include "fusion/fusion_options.h"

namespace softscope {

/// Point spacing at that depth: docs/fusion.md (F14). mm.
SOFTSCOPE_HD inline float spacingAt(float depth_mm, float focal_px, float spacing_mm) {
  const float most_mm = static_cast<float>(InsertionOptions::kMostSpacingPx) * depth_mm / focal_px;
  return most_mm < spacing_mm ? most_mm : spacing_mm;
}

/// Number of halvings of a cell of width `spacing_mm` for points at that depth: (F17).
SOFTSCOPE_HD inline int halvingsAt(float depth_mm, float focal_px, float spacing_mm) {
  constexpr int kMostHalvings = 5;
  int halvings = 0;
  if (!(depth_mm > 0)) return halvings;
  const float widest_mm = spacingAt(depth_mm, focal_px, spacing_mm);
  for (float cell_mm = spacing_mm; cell_mm > widest_mm && halvings < kMostHalvings; cell_mm /= 2)
    ++halvings;
  return halvings;
}

}  // namespace softscope
