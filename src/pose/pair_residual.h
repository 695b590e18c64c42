// src/pose/pair_residual.h: residual of one pair at a pose: docs/energy.md (26) to (29), for the
// CPU and the GPU.
#pragma once

#include <cmath>

#include "core/hd.h"
#include "core/rectified_rig.h"

namespace softscope {

constexpr double kCostScaleSq = 9;  // three standard errors

/// Model positions of a pair: in the last fused frame, and in the reference shape.
enum class PairPlace { kNow, kSince };

/// One pair, prepared for the inner loops. 11 doubles.
struct SeenPair {
  double place_mm[2][3];  // world, by PairPlace
  double live_px[2], disparity_px;
  double across, along;  // factors that whiten a residual in the image, and in disparity
};

/// Left camera from world, row by row.
struct PoseRows {
  double at[3][4];
};

/// Whitened residuals of one pair (u, v, disparity) and their derivatives with
/// respect to a twist of the pose: rotation, then translation, p' = p + w x p + t.
struct PairResidual {
  double value[3];
  double slope[3][6];
  bool usable;

  SOFTSCOPE_HD double squared() const {
    return value[0] * value[0] + value[1] * value[1] + value[2] * value[2];
  }
};

/// docs/energy.md (26).
SOFTSCOPE_HD inline PairResidual pairResidual(const SeenPair& pair, PairPlace place,
                                              const RectifiedRig& rig, const PoseRows& pose) {
  PairResidual out{};
  const double(&from)[3] = pair.place_mm[static_cast<int>(place)];
  double p[3];
  for (int i = 0; i < 3; ++i)
    p[i] =
        pose.at[i][0] * from[0] + pose.at[i][1] * from[1] + pose.at[i][2] * from[2] + pose.at[i][3];
  const double x = p[0], y = p[1], z = p[2];
  if (!(z > 1e-3) || !std::isfinite(pair.across) || !std::isfinite(pair.along)) return out;
  const double fx = rig.left.fx_px, fy = rig.left.fy_px;
  const double u_by_x = fx / z, u_by_z = -fx * x / (z * z), v_by_y = fy / z,
               v_by_z = -fy * y / (z * z), d_by_z = -fx * rig.baseline_mm / (z * z);
  const double slope[3][6] = {
      {u_by_z * y, u_by_x * z + u_by_z * -x, u_by_x * -y, u_by_x, 0, u_by_z},
      {v_by_y * -z + v_by_z * y, v_by_z * -x, v_by_y * x, 0, v_by_y, v_by_z},
      {d_by_z * y, d_by_z * -x, 0, 0, 0, d_by_z}};
  const Eigen::Vector2d seen_px = projectPoint(rig.left, Eigen::Vector3d(x, y, z));
  const double weights[3] = {pair.across, pair.across, pair.along};
  out.value[0] = weights[0] * (seen_px.x() - pair.live_px[0]);
  out.value[1] = weights[1] * (seen_px.y() - pair.live_px[1]);
  out.value[2] = weights[2] * (rig.disparityPx(z) - pair.disparity_px);
  out.usable = true;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 6; ++j) out.slope[i][j] = weights[i] * slope[i][j];
    out.usable = out.usable && std::isfinite(out.value[i]);
  }
  return out;
}

/// Robust cost of a pair, 0 to 1: docs/energy.md (28).
SOFTSCOPE_HD inline double pairCost(double squared) { return squared / (squared + kCostScaleSq); }

/// Square of the robust scale c from the median of the squared residuals: docs/energy.md (27).
/// `of_median`: c over the median, where that is large.
SOFTSCOPE_HD inline double robustScaleSq(double median_squared, double of_median) {
  constexpr double kLeast = 2;  // standard errors
  const double scale_sq = of_median * of_median * median_squared;
  return scale_sq > kLeast * kLeast ? scale_sq : kLeast * kLeast;
}

/// Weight of Geman and McClure: docs/energy.md (27).
SOFTSCOPE_HD inline double pairWeight(double squared, double scale_sq) {
  const double share = scale_sq / (scale_sq + squared);
  return share * share;
}

/// Second derivative of that cost as a factor of the pair's normal matrix, averaged over the
/// directions of the residual: docs/energy.md (31).
SOFTSCOPE_HD inline double pairCurvature(double squared, double scale_sq) {
  return pairWeight(squared, scale_sq) * (1 - 4.0 / 3 * squared / (scale_sq + squared));
}

// Parts of the extent of the pairs in the image, with independent errors.
constexpr int kRegionColumns = 6, kRegionRows = 4, kRegions = kRegionColumns * kRegionRows;

/// The extent that the regions divide.
struct PairRegions {
  double first_px[2], size_px[2];

  SOFTSCOPE_HD int of(const double (&live_px)[2]) const {
    return part((live_px[1] - first_px[1]) / size_px[1], kRegionRows) * kRegionColumns +
           part((live_px[0] - first_px[0]) / size_px[0], kRegionColumns);
  }

 private:
  SOFTSCOPE_HD static int part(double share, int count) {
    const int number = static_cast<int>(share * count);
    return number < 0 ? 0 : number < count ? number : count - 1;
  }
};

}  // namespace softscope
