// src/pipeline/nearest_depth.h: depth beside a pixel that may have none.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/raster.h"

namespace softscope {

constexpr int kSmallGapPx = 6;

/// As far as a gap of depth is taken for the surface around it: this share of the image's width.
inline int gapPx(int width_px) {
  constexpr int kGapShare = 40;
  return std::max(kSmallGapPx, width_px / kGapShare);
}

/// Calls visit(x, y, depth) for the measured pixels within `radius_px`, x and y from `pixel`.
template <class Visit>
void visitMeasured(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel, int radius_px,
                   const Visit& visit) {
  const int u0 = static_cast<int>(std::lround(pixel.x()));
  const int v0 = static_cast<int>(std::lround(pixel.y()));
  for (int v = v0 - radius_px; v <= v0 + radius_px; ++v)
    for (int u = u0 - radius_px; u <= u0 + radius_px; ++u)
      if (depth_mm.contains(u, v) && std::isfinite(depth_mm.at(u, v)))
        visit(u - pixel.x(), v - pixel.y(), depth_mm.at(u, v));
}

struct NearestDepth {
  double depth_mm = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector2d away_px = Eigen::Vector2d::Zero();  // of the pixel that has it

  bool found() const { return std::isfinite(depth_mm); }
  /// How far another pixel's surface may lie from it: at 45 degrees, mm.
  double slackMm(double focal_px) const { return away_px.norm() * depth_mm / focal_px; }
};

/// Of the measured pixel that is nearest; NaN where none lies within `radius_px`.
inline NearestDepth nearestDepth(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel,
                                 int radius_px) {
  NearestDepth nearest;
  double distance_px = radius_px + 1.0;
  visitMeasured(depth_mm, pixel, radius_px, [&](double x, double y, float depth) {
    if (!(std::hypot(x, y) < distance_px)) return;
    distance_px = std::hypot(x, y);
    nearest = {depth, {x, y}};
  });
  return nearest;
}

}  // namespace softscope
