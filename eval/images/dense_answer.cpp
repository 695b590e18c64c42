#include "eval/images/dense_answer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace softscope {

Raster<float> fillFromNearest(const Raster<float>& depth_mm) {
  Raster<float> filled = depth_mm;
  std::vector<std::pair<int, int>> front;
  for (int v = 0; v < filled.height_px; ++v)
    for (int u = 0; u < filled.width_px; ++u)
      if (std::isfinite(filled.at(u, v))) front.emplace_back(u, v);
  constexpr std::array<std::pair<int, int>, 4> kSteps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  for (std::size_t next = 0; next < front.size(); ++next) {
    const auto [u, v] = front[next];
    for (const auto& [du, dv] : kSteps) {
      if (!filled.contains(u + du, v + dv) || std::isfinite(filled.at(u + du, v + dv))) continue;
      filled.at(u + du, v + dv) = filled.at(u, v);
      front.emplace_back(u + du, v + dv);
    }
  }
  return filled;
}

Mask hiddenInRight(const Raster<float>& true_disparity_px, double margin_px) {
  const int width = true_disparity_px.width_px;
  Mask hidden(width, true_disparity_px.height_px, 0);
  for (int v = 0; v < hidden.height_px; ++v) {
    std::vector<float> nearest(static_cast<std::size_t>(width), 0);
    const auto matchOf = [&](int u) {
      const double at = u - static_cast<double>(true_disparity_px.at(u, v));
      return std::abs(at) < 1e6 ? static_cast<int>(std::lround(at)) : -1;
    };
    const auto inside = [&](int match) { return match >= 0 && match < width; };
    for (int u = 0; u < width; ++u) {
      const float disparity_px = true_disparity_px.at(u, v);
      if (!std::isfinite(disparity_px) || !inside(matchOf(u))) continue;
      float& there = nearest[static_cast<std::size_t>(matchOf(u))];
      there = std::max(there, disparity_px);
    }
    for (int u = 0; u < width; ++u) {
      const float disparity_px = true_disparity_px.at(u, v);
      if (!std::isfinite(disparity_px)) continue;
      const int match = matchOf(u);
      hidden.at(u, v) =
          !inside(match) || nearest[static_cast<std::size_t>(match)] > disparity_px + margin_px;
    }
  }
  return hidden;
}

}  // namespace softscope
