// src/fusion/insertion_formulas.h: conversion of a pixel to a model point, for the CPU and the GPU.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>

#include "core/hd.h"
#include "fusion/cell_table.h"
#include "fusion/fusing_formulas.h"
#include "fusion/fusion_options.h"
#include "fusion/model_point.h"
#include "fusion/observation.h"
#include "fusion/point_spacing.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// Options of insertion in single precision, for the inner loops.
struct InsertionLimits {
  float spacing_mm = 0, max_sigma_mm = 0, max_sigma_over_square_per_mm = 0, band_mm = 0;
};

inline InsertionLimits insertionLimits(const InsertionOptions& options) {
  return {static_cast<float>(options.spacing_mm), static_cast<float>(options.max_sigma_mm),
          static_cast<float>(options.max_sigma_over_square_per_mm),
          static_cast<float>(options.band_mm)};
}

constexpr int kMostFootprintPx = 10;

/// Minimum distance of a new point to others, pixels: docs/fusion.md (F14).
SOFTSCOPE_HD inline int footprintPx(float depth_mm, float focal_px, float spacing_mm) {
  const float spacing_px = spacingAt(depth_mm, focal_px, spacing_mm) * focal_px / depth_mm;
  const float bounded_px = 100 < spacing_px ? 100.0f : spacing_px;
  // In double precision, the sum is exact: truncation rounds.
  const int rounded = static_cast<int>(static_cast<double>(bounded_px) + 0.5);
  return rounded < 1 ? 1 : (kMostFootprintPx < rounded ? kMostFootprintPx : rounded);
}

/// Whether the depth of a pixel is accurate enough for a point. `sigma_mm`: null for depths without
/// sigma.
SOFTSCOPE_HD inline bool mayMakePoint(PixelState state, float depth_mm, const float* sigma_mm,
                                      int pixel, const InsertionLimits& limits) {
  if (state != PixelState::kAccepted) return false;
  if (sigma_mm == nullptr) return true;
  return sigma_mm[pixel] <= limits.max_sigma_mm &&
         sigma_mm[pixel] <= limits.max_sigma_over_square_per_mm * (depth_mm * depth_mm);
}

/// Whether the nearest model depth within reach of a pixel
/// is not behind the band of the measured depth: (F14).
SOFTSCOPE_HD inline bool isExplained(float nearest_mm, float depth_mm, float band_mm) {
  return nearest_mm < depth_mm + band_mm;
}

/// Unexplained depths of the last frame; non-owning.
struct LastUnexplained {
  const float* depth_mm = nullptr;  // NaN: explained, or not measured
  int width_px = 0, height_px = 0;
  PosedCamera camera;
};

/// Whether the last frame had an unexplained depth at this position: (F15).
SOFTSCOPE_HD inline bool isConfirmed(const Eigen::Vector3f& point_world,
                                     const LastUnexplained& last, float band_mm) {
  const Eigen::Vector3f left = last.camera.toLeft(point_world);
  int u0, v0;
  if (!last.camera.findPixel(left, &u0, &v0)) return false;
  for (int v = v0 - 1; v <= v0 + 1; ++v)
    for (int u = u0 - 1; u <= u0 + 1; ++u) {
      if (u < 0 || v < 0 || u >= last.width_px || v >= last.height_px) continue;
      if (std::abs(last.depth_mm[v * last.width_px + u] - left.z()) < band_mm) return true;
    }
  return false;
}

/// Cell of at most one new point: (F16).
SOFTSCOPE_HD inline CellKey insertionCell(const Eigen::Vector3f& ray, float depth_mm,
                                          float focal_px, const InsertionLimits& limits) {
  const float side_mm = spacingAt(depth_mm, focal_px, limits.spacing_mm);
  return cellKey(ray * depth_mm, {side_mm, side_mm, limits.band_mm});
}

/// Model point of a pixel.
SOFTSCOPE_HD inline ModelPoint newPoint(std::int32_t pixel, const FusingFrame& frame) {
  const FrameRasters& rasters = frame.rasters;
  const PosedCamera& camera = frame.camera;
  const Eigen::Vector3f left =
      camera.ray(pixel % camera.width_px, pixel / camera.width_px) * rasters.depth_mm[pixel];
  const float measured = depthWeightAt(pixel, frame);
  ModelPoint point;
  point.position_mm = camera.toWorld(left);
  point.normal = camera.left_from_world.transpose() * rasters.normals[pixel];
  if (rasters.colour != nullptr) point.colour = modelColour(rasters.colour[pixel], frame.gain);
  point.anchor = toGray(point.colour);
  point.weight = frame.limits.max_weight < measured ? frame.limits.max_weight : measured;
  return point;
}

}  // namespace softscope
