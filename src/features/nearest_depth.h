// src/features/nearest_depth.h: depth near a pixel that may have none.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/raster.h"

namespace softscope {

constexpr int kSmallGapPx = 6;

/// Maximum width of a gap of depth that counts as surface: this share of the width of the image.
inline int gapPx(int width_px) {
  constexpr int kGapShare = 40;
  return std::max(kSmallGapPx, width_px / kGapShare);
}

/// Calls visit(x, y, depth) for measured pixels within `radius_px`; x, y relative to `pixel`.
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

inline int measuredAround(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel,
                          int radius_px) {
  int measured = 0;
  visitMeasured(depth_mm, pixel, radius_px, [&](double, double, float) { ++measured; });
  return measured;
}

/// A pixel has a depth of its own where most of the pixels this close to it are measured.
constexpr int kOwnRadiusPx = 2, kOwnLeast = 13;

inline bool hasOwnDepth(const Raster<float>& depth_mm, const Eigen::Vector2d& pixel) {
  return measuredAround(depth_mm, pixel, kOwnRadiusPx) >= kOwnLeast;
}

/// Steepest surface that is followed: depth over width.
constexpr double kSteepest = 4;

struct NearestDepth {
  double depth_mm = std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector2d away_px = Eigen::Vector2d::Zero();  // offset of the pixel that has it

  bool found() const { return std::isfinite(depth_mm); }
  /// Maximum depth difference to the surface of another pixel: at 45 degrees, mm.
  double slackMm(double focal_px) const { return away_px.norm() * depth_mm / focal_px; }
};

/// Depth of the nearest measured pixel; NaN without one within `radius_px`.
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
