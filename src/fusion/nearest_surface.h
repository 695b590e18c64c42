// src/fusion/nearest_surface.h: how near the model itself comes to the camera, square by square.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "fusion/observation.h"

namespace softscope {

/// A coarse depth buffer. Points may be added from several threads: the nearest wins, whatever the
/// order.
class NearestSurface {
 public:
  NearestSurface(int width_px, int height_px, int cell_px)
      : cell_px_(cell_px),
        columns_((width_px + cell_px - 1) / cell_px),
        bits_(static_cast<std::size_t>(columns_) * ((height_px + cell_px - 1) / cell_px)) {
    parallelRanges(static_cast<int>(bits_.size()), kCellsATask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        bits_[static_cast<std::size_t>(i)].store(kFar, std::memory_order_relaxed);
    });
  }

  void add(int u, int v, float depth_mm) {
    std::uint32_t mine;  // positive floats sort as their bits do
    std::memcpy(&mine, &depth_mm, sizeof mine);
    std::atomic<std::uint32_t>& bits = cell(u, v);
    std::uint32_t nearest = bits.load(std::memory_order_relaxed);
    while (mine < nearest && !bits.compare_exchange_weak(nearest, mine, std::memory_order_relaxed))
      ;
  }

  /// The nearest depth that was added to the square of pixel (u, v); infinite where none was.
  float depthAt(int u, int v) const {
    const std::uint32_t bits = cell(u, v).load(std::memory_order_relaxed);
    float depth_mm;
    std::memcpy(&depth_mm, &bits, sizeof depth_mm);
    return depth_mm;
  }

  /// Whether the point lies clearly behind: docs/fusion.md (F4). The square's own extent counts by
  /// the slope of the point's surface. `cosine`: between the point's normal and its ray.
  bool hides(int u, int v, float depth_mm, float cosine, float focal_px, float margin_mm) const {
    const float steep = cosine > kLeastCosine ? cosine : kLeastCosine;
    const float slope = std::sqrt(1 - steep * steep) / steep;
    const float extent_mm = 1.5f * static_cast<float>(cell_px_) * depth_mm / focal_px;
    return depth_mm > depthAt(u, v) + margin_mm + slope * extent_mm;
  }

 private:
  static constexpr int kCellsATask = 1 << 15;
  static constexpr std::uint32_t kFar = 0x7F800000;  // infinity
  static constexpr float kLeastCosine = 0.1f;

  std::atomic<std::uint32_t>& cell(int u, int v) {
    return bits_[static_cast<std::size_t>(v / cell_px_) * columns_ + u / cell_px_];
  }
  const std::atomic<std::uint32_t>& cell(int u, int v) const {
    return bits_[static_cast<std::size_t>(v / cell_px_) * columns_ + u / cell_px_];
  }

  int cell_px_, columns_;
  std::vector<std::atomic<std::uint32_t>> bits_;
};

}  // namespace softscope
