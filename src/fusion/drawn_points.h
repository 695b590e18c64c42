// src/fusion/drawn_points.h: index of the model point shown by each pixel.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/hd.h"
#include "core/point_model.h"
#include "core/raster.h"
#include "fusion/nearest_surface.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// Depth buffer of points, one pixel each; points behind the nearest surface of the model
/// are occluded. Deterministic for any number of threads. The model must outlive it.
class DrawnPoints {
 public:
  static constexpr int kCellPx = 4;    // squares in which nearer points occlude others …
  static constexpr float kHideMm = 1;  // … this far behind
  static constexpr std::uint64_t kNoPoint = ~std::uint64_t{0};
  /// Bits of the depth above, index below: the smallest is the nearest point, the first of equals.
  SOFTSCOPE_HD static std::uint64_t entry(std::uint32_t depth_bits, int index) {
    return std::uint64_t{depth_bits} << 32 | static_cast<std::uint32_t>(index);
  }
  SOFTSCOPE_HD static std::int32_t pointOf(std::uint64_t entry) {
    return static_cast<std::int32_t>(entry & 0xFFFFFFFFu);
  }

  DrawnPoints(const PointModel& model, const PosedCamera& camera);

  const PointModel& model() const { return model_; }
  const PosedCamera& camera() const { return camera_; }

  /// Point shown by pixel (u, v); negative if none.
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
