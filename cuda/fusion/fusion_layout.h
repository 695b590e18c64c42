// cuda/fusion/fusion_layout.h: every array of stage 7, planned from sizes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/warp_graph.h"
#include "cuda/device/arena.h"
#include "cuda/device/ordered_list.h"
#include "cuda/model/model_layout.h"
#include "fusion/cell_table.h"
#include "fusion/innovation.h"
#include "fusion/observation.h"
#include "fusion/sight.h"

namespace softscope::cuda {

/// What comes down before the model.
struct FusionCounts {
  int seen, fused, contradicted;
  int unexplained_px, inserted;
  int listed;  // points with a cell
  int kept;    // points of the model as it is afterwards
};

/// Blocks of the image whose anchors agree with it; owns nothing.
struct AnchoredBlocks {
  const std::uint8_t* agrees = nullptr;  // null: none
  int width_px = 0, block_px = 1, columns = 0;

  SOFTSCOPE_HD bool at(int pixel) const {
    if (agrees == nullptr) return false;
    const int u = pixel % width_px, v = pixel / width_px;
    return agrees[v / block_px * columns + u / block_px] != 0;
  }
};

/// Arrays of the image's size.
struct FusionFrameLayout {
  FusionFrameLayout() = default;
  FusionFrameLayout(Arena& arena, std::size_t pixels) {
    for (float*& depth_mm : unexplained_mm) depth_mm = arena.array<float>(pixels);
    nearest = arena.array<std::uint32_t>(pixels);
    slots = arena.array<std::int32_t>(pixels);
    anchored = arena.array<std::uint8_t>(pixels);  // more than there are blocks
    counts = arena.array<FusionCounts>(1);
  }

  float* unexplained_mm[2] = {nullptr, nullptr};  // of this frame and of the last one
  std::uint32_t* nearest = nullptr;               // bits of the model's depths
  std::int32_t* slots = nullptr;                  // of a pixel's cell; -1: makes no point
  std::uint8_t* anchored = nullptr;
  FusionCounts* counts = nullptr;
};

/// Arrays of the model's size with all the points that a frame may add, and a table of cells.
struct FusionPointLayout {
  FusionPointLayout() = default;
  FusionPointLayout(Arena& arena, std::size_t point_capacity) : capacity(point_capacity) {
    while (slot_count < 2 * capacity) slot_count *= 2;
    sights = arena.array<PointSight>(capacity);
    slots = arena.array<std::int32_t>(capacity);
    heirs = arena.array<std::int32_t>(capacity);
    new_of_old = arena.array<std::int32_t>(capacity);
    order = arena.array<std::int32_t>(capacity);
    block_counts = arena.array<int>(capacity / kListBlock + 1);
    keys = arena.array<unsigned long long>(slot_count);
    values = arena.array<std::uint32_t>(slot_count);
    ends = arena.array<int>(slot_count);
  }

  std::size_t capacity = 0, slot_count = 16;
  PointSight* sights = nullptr;
  std::int32_t* slots = nullptr;  // of a point's cell; -1: does not stay
  std::int32_t* heirs = nullptr;  // itself, the point into which it was merged, or kRemoved
  std::int32_t *new_of_old = nullptr, *order = nullptr;  // points by cell
  int* block_counts = nullptr;
  unsigned long long* keys = nullptr;  // kNoCell: free
  std::uint32_t* values = nullptr;     // least pixel, or number of points
  int* ends = nullptr;                 // of a cell's points in `order`
};

/// The nodes that carry the points.
struct FusionGraphLayout {
  FusionGraphLayout() = default;
  FusionGraphLayout(Arena& arena, std::size_t nodes, std::size_t sets)
      : stencil_count(static_cast<int>(sets)) {
    stencils = arena.array<NodeStencil>(sets);
    nodes_mm = arena.array<Eigen::Vector3d>(nodes);
    innovation = arena.array<Innovation>(nodes);
  }

  int stencil_count = 0;
  bool has_innovation = false;
  NodeStencil* stencils = nullptr;
  Eigen::Vector3d* nodes_mm = nullptr;
  Innovation* innovation = nullptr;
};

}  // namespace softscope::cuda
