// src/fusion/drawn_points.h: the model point that each pixel shows.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/point_model.h"
#include "core/raster.h"
#include "fusion/nearest_surface.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// A depth buffer of points, one pixel each; what lies behind the model's own nearest surface is
/// hidden. Same input, same result on any number of threads. The model must outlive it.
class DrawnPoints {
 public:
  DrawnPoints(const PointModel& model, const PosedCamera& camera);

  const PointModel& model() const { return model_; }
  const PosedCamera& camera() const { return camera_; }

  /// The point that pixel (u, v) shows; below 0 where there is none.
  int pointAt(int u, int v) const { return shown_.at(u, v); }

 private:
  void draw(int i);
  std::int32_t findShown(int u, int v) const;

  const PointModel& model_;
  PosedCamera camera_;
  NearestSurface surface_;
  std::vector<std::atomic<std::uint64_t>> nearest_;
  Raster<std::int32_t> shown_;
};

}  // namespace softscope
