// src/fusion/sight_formulas.h: visibility of one model point, for the CPU and the GPU.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "core/hd.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/posed_camera.h"
#include "fusion/sight.h"

namespace softscope {

/// Rasters of an observation with the states of its pixels; non-owning.
struct SightRasters {
  const float* depth_mm = nullptr;
  const Eigen::Vector3f* normals = nullptr;
  const PixelState* states = nullptr;
};

inline SightLimits sightLimits(const VisibilityOptions& options) {
  return {static_cast<float>(options.max_distance_mm),
          static_cast<float>(std::cos(VisibilityOptions::kMaxAngleDeg * M_PI / 180))};
}

SOFTSCOPE_HD inline bool isFinite(const Eigen::Vector3f& point) {
  return std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z());
}

/// Comparison of one point with the measurement: docs/fusion.md (F1) to (F3).
SOFTSCOPE_HD inline PointSight sightOf(const Eigen::Vector3f& point_left,
                                       const Eigen::Vector3f& normal_left,
                                       const PosedCamera& camera, const SightRasters& rasters,
                                       const SightLimits& limits) {
  PointSight result;
  int u, v;
  if (!isFinite(point_left) || !camera.findPixel(point_left, &u, &v)) return result;
  const int pixel = v * camera.width_px + u;
  const PixelState state = rasters.states[pixel];
  if (state == PixelState::kAccepted)
    result = compareWithPixel(point_left, normal_left, camera.ray(u, v) * rasters.depth_mm[pixel],
                              rasters.normals[pixel], limits);
  else
    result.sight = state == PixelState::kMasked ? Sight::kMasked : Sight::kUnknown;
  result.pixel = pixel;
  return result;
}

/// Between the normal of the point and its ray; both in the left camera frame.
SOFTSCOPE_HD inline float cosineToRay(const Eigen::Vector3f& point_left,
                                      const Eigen::Vector3f& normal_left) {
  return -normal_left.dot(point_left) / point_left.norm();
}

/// Whether a point is clearly behind the nearest depth of its square of `cell_px` pixels:
/// docs/fusion.md (F4). The extent of the square is included by the slope of the surface.
SOFTSCOPE_HD inline bool liesBehind(float nearest_mm, int cell_px, float depth_mm, float cosine,
                                    float focal_px, float margin_mm) {
  constexpr float kLeastCosine = 0.1f;
  const float steep = cosine > kLeastCosine ? cosine : kLeastCosine;
  const float slope = std::sqrt(1 - steep * steep) / steep;
  const float extent_mm = 1.5f * static_cast<float>(cell_px) * depth_mm / focal_px;
  return depth_mm > nearest_mm + margin_mm + slope * extent_mm;
}

}  // namespace softscope
