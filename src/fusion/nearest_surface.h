// src/fusion/nearest_surface.h: nearest depth of the model per image block.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "core/parallel.h"
#include "fusion/sight_formulas.h"

namespace softscope {

/// Coarse depth buffer. Points may be added by several
/// threads: the nearest is kept, in any order.
class NearestSurface {
 public:
  NearestSurface(int width_px, int height_px, int cell_px)
      : cell_px_(cell_px),
        columns_((width_px + cell_px - 1) / cell_px),
        bits_(static_cast<std::size_t>(columns_) * ((height_px + cell_px - 1) / cell_px)) {
    parallelRanges(static_cast<int>(bits_.size()), kCellsPerTask, [&](int begin, int end) {
      for (int i = begin; i < end; ++i)
        bits_[static_cast<std::size_t>(i)].store(kFar, std::memory_order_relaxed);
    });
  }

  void add(int u, int v, float depth_mm) {
    std::uint32_t mine;  // bits of positive floats have their order
    std::memcpy(&mine, &depth_mm, sizeof mine);
    std::atomic<std::uint32_t>& bits = cell(u, v);
    std::uint32_t nearest = bits.load(std::memory_order_relaxed);
    while (mine < nearest && !bits.compare_exchange_weak(nearest, mine, std::memory_order_relaxed))
      ;
  }

  /// Nearest depth added to the square of pixel (u, v); infinite if none.
  float depthAt(int u, int v) const {
    const std::uint32_t bits = cell(u, v).load(std::memory_order_relaxed);
    float depth_mm;
    std::memcpy(&depth_mm, &bits, sizeof depth_mm);
    return depth_mm;
  }

  /// False for most points: then hides() is false for any cosine.
  bool mayHide(int u, int v, float depth_mm, float margin_mm) const {
    return depth_mm > depthAt(u, v) + margin_mm;
  }
  /// Whether the point is clearly behind: liesBehind(). `cosine`: cosineToRay() of the point.
  bool hides(int u, int v, float depth_mm, float cosine, float focal_px, float margin_mm) const {
    return liesBehind(depthAt(u, v), cell_px_, depth_mm, cosine, focal_px, margin_mm);
  }

 private:
  static constexpr int kCellsPerTask = 1 << 15;
  static constexpr std::uint32_t kFar = 0x7F800000;  // infinity

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
