// src/fusion/surface_formulas.h: the model's surface around a position; the formulas of all back
// ends.
#pragma once

#include <Eigen/Core>

#include "core/hd.h"

namespace softscope {

constexpr double kSurfacePieceMm = 0.7;  // radius of the surface piece of a position

/// Contribution of one model point to the piece of a position.
struct SurfaceShare {
  double weight, height_mm;
  double normal[3];
};

/// False where the point does not belong to the piece. The sums have one order in every build.
SOFTSCOPE_HD inline bool surfaceShare(const Eigen::Vector3f& point_mm,
                                      const Eigen::Vector3f& normal, float point_weight,
                                      const Eigen::Vector3d& position_mm, SurfaceShare* share) {
  double away[3];
  for (int c = 0; c < 3; ++c) away[c] = static_cast<double>(point_mm[c]) - position_mm[c];
  const double distance_sq = (away[0] * away[0] + away[1] * away[1]) + away[2] * away[2];
  const double part = 1 - distance_sq / (kSurfacePieceMm * kSurfacePieceMm);
  if (!(part > 0)) return false;
  const double n[] = {normal[0], normal[1], normal[2]};
  share->weight = part * point_weight;
  share->height_mm = share->weight * ((n[0] * away[0] + n[1] * away[1]) + n[2] * away[2]);
  for (int c = 0; c < 3; ++c) share->normal[c] = share->weight * n[c];
  return true;
}

/// Squared distance, for the comparison of distances.
SOFTSCOPE_HD inline float squaredDistance(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  const float away[] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return away[0] * away[0] + (away[1] * away[1] + away[2] * away[2]);
}

}  // namespace softscope
