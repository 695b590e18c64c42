// src/features/lift_formulas.h: formulas that lift matched pixels to points, for the CPU and the
// GPU.
#pragma once

#include <cmath>

#include "core/camera.h"
#include "core/hd.h"

namespace softscope {

constexpr float kLiftStepMm = 1;  // larger differences of four pixels are depth discontinuities

SOFTSCOPE_HD inline int nearestPixel(float x) { return static_cast<int>(std::lround(x)); }

/// Depth at a sub-pixel position, bilinear in the inverse depth; 0 if one of the four pixels
/// is unmeasured or they differ by more than `max_step_mm`. `depth(u, v)` reads a pixel.
template <class Depth>
SOFTSCOPE_HD inline float depthBetween(const Depth& depth, int width, int height, float u_px,
                                       float v_px, float max_step_mm) {
  const float fu = std::floor(u_px), fv = std::floor(v_px);
  if (!(fu >= 0 && fv >= 0 && u_px <= static_cast<float>(width - 1) &&
        v_px <= static_cast<float>(height - 1)))
    return 0;
  const int u = static_cast<int>(fu), v = static_cast<int>(fv);
  const int right = u + 1 < width ? u + 1 : width - 1, below = v + 1 < height ? v + 1 : height - 1;
  const float four[4] = {depth(u, v), depth(right, v), depth(u, below), depth(right, below)};
  float least = four[0], most = four[0];
  for (const float each : four) {
    if (!(each > 0)) return 0;
    least = each < least ? each : least;
    most = each > most ? each : most;
  }
  if (!(most - least <= max_step_mm)) return 0;
  const float x = u_px - fu, y = v_px - fv;
  return 1 / ((1 - y) * ((1 - x) / four[0] + x / four[1]) + y * ((1 - x) / four[2] + x / four[3]));
}

/// Rigid motion in floats, row by row.
struct RigidRows {
  float turn[3][3], shift[3];

  SOFTSCOPE_HD void move(const float (&from)[3], float (&to)[3]) const {
    for (int i = 0; i < 3; ++i)
      to[i] = turn[i][0] * from[0] + turn[i][1] * from[1] + turn[i][2] * from[2] + shift[i];
  }
};

/// Predicted standard error across the ray of the live camera, mm.
SOFTSCOPE_HD inline float acrossMm(float sigma_px, float live_mm, const PinholeCamera& camera) {
  return sigma_px * live_mm / static_cast<float>(camera.fx_px);
}

}  // namespace softscope
