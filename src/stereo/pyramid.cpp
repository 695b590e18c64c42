#include "stereo/pyramid.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr float kOneSurfacePx = 1.5f;  // four pixels that differ by more lie on two surfaces

/// Bilinear value at a quarter of a pixel from the nearest centre; NaN across a step or a hole.
float interpolate(const Raster<float>& values, int u0, int v0, float fu, float fv) {
  const int u1 = std::min(u0 + 1, values.width_px - 1), v1 = std::min(v0 + 1, values.height_px - 1);
  const float a = values.at(u0, v0), b = values.at(u1, v0), c = values.at(u0, v1),
              d = values.at(u1, v1);
  return (1 - fv) * ((1 - fu) * a + fu * b) + fv * ((1 - fu) * c + fu * d);
}

float spreadOf(const Raster<float>& values, int u0, int v0) {
  const int u1 = std::min(u0 + 1, values.width_px - 1), v1 = std::min(v0 + 1, values.height_px - 1);
  const auto [low, high] =
      std::minmax({values.at(u0, v0), values.at(u1, v0), values.at(u0, v1), values.at(u1, v1)});
  return high - low;
}

}  // namespace

void fillFromHalf(const DisparityMap& half, DisparityMap& fine) {
  const Raster<float>& coarse = half.disparity_px;
  parallelRows(fine.disparity_px.height_px, [&](int v) {
    for (int u = 0; u < fine.disparity_px.width_px; ++u) {
      if (!std::isnan(fine.disparity_px.at(u, v))) continue;
      const float x = std::max(0.5f * static_cast<float>(u) - 0.25f, 0.0f);
      const float y = std::max(0.5f * static_cast<float>(v) - 0.25f, 0.0f);
      const int u0 = static_cast<int>(x), v0 = static_cast<int>(y);
      if (!coarse.contains(u0, v0) || !(spreadOf(coarse, u0, v0) <= kOneSurfacePx)) continue;
      const float fu = x - static_cast<float>(u0), fv = y - static_cast<float>(v0);
      fine.disparity_px.at(u, v) = 2 * interpolate(coarse, u0, v0, fu, fv);
      fine.sigma_px.at(u, v) = 2 * interpolate(half.sigma_px, u0, v0, fu, fv);
    }
  });
}

}  // namespace softscope
