// cuda/warp/warp_points.h: kernel bodies that list the seen points of the model by stencil.
#pragma once

#include "cuda/device/fixed_sum.h"
#include "cuda/device/kernel.h"
#include "cuda/model/model_layout.h"
#include "cuda/warp/warp_layout.h"

namespace softscope::cuda {

/// What comes down of a list.
struct PointListCounts {
  int listed, longest;  // points in all, and of a stencil
};

/// Arrays of the list, beside the points that it gives.
struct PointListLayout {
  PointListLayout() = default;
  PointListLayout(Arena& arena, std::size_t stencil_count, std::size_t node_count,
                  std::size_t points)
      : stencils(static_cast<int>(stencil_count)), nodes(static_cast<int>(node_count)) {
    filled = arena.array<int>(stencil_count);
    shares = arena.array<FixedSum>(2 * kNodesPerPoint * stencil_count);
    loads = arena.array<FixedSum>(2 * node_count);
    order = arena.array<std::int32_t>(points);
    counts = arena.array<PointListCounts>(1);
  }

  int stencils = 0, nodes = 0;
  int* filled = nullptr;
  FixedSum* shares = nullptr;  // weights of all points of a stencil per node, then of the seen ones
  FixedSum* loads = nullptr;   // the same of each node: all, then seen
  std::int32_t* order = nullptr;
  PointListCounts* counts = nullptr;
};

/// The model, and which of its points are seen.
struct SeenModel {
  ModelArrays model;
  const std::uint8_t* seen;
  int count;

  /// Bound, finite and seen.
  SOFTSCOPE_HD bool isListed(int i) const {
    return seen[i] != 0 && model.bindings[i].bound() && isFinite(model.positions_mm[i]) &&
           isFinite(model.normals[i]);
  }
  Grid blocks(int threads) const { return {blocksFor(count, threads), 1, 1}; }

 private:
  SOFTSCOPE_HD static bool isFinite(const Eigen::Vector3f& v) {
    return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
  }
};

/// A thread per point: counts the listed ones of each stencil, and adds up weights.
struct CountPointsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  SeenModel of;
  PointListLayout list;
  int* counts;  // per stencil

  Grid blocks() const { return of.blocks(kThreads); }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= of.count || !of.model.bindings[i].bound()) return;
    const PointBinding& binding = of.model.bindings[i];
    const bool is_listed = of.isListed(i);
    if (is_listed) atomicPlus(&counts[binding.stencil], 1);
    FixedSum* all = list.shares + 2 * kNodesPerPoint * binding.stencil;
    for (std::size_t k = 0; k < kNodesPerPoint; ++k) {
      const FixedSum weight = toFixed(binding.weights[k]);
      if (weight == 0) continue;
      atomicPlus(&all[k], weight);
      if (is_listed) atomicPlus(&all[kNodesPerPoint + k], weight);
    }
  }
};

/// After the starts are known, a thread per point: its place in the list, in any order.
struct ListPointsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  SeenModel of;
  PointListLayout list;
  const int* start;

  Grid blocks() const { return of.blocks(kThreads); }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= of.count || !of.isListed(i)) return;
    const std::int32_t stencil = of.model.bindings[i].stencil;
    list.order[start[stencil] + atomicPlus(&list.filled[stencil], 1)] = i;
  }
};

/// A block per stencil: its points in the order of the model. Every point counts those before it.
struct SortPointsKernel {
  static constexpr int kThreads = 128, kPhases = 1, kMost = 4096;
  using Shared = Nothing;
  using Local = Nothing;
  SeenModel of;
  PointListLayout list;
  const int* start;
  WarpPointLayout points;

  Grid blocks() const { return {list.stencils, 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int first = start[at.x], count = start[at.x + 1] - first;
    if (at.thread == 0) {
      atomicGreatest(&list.counts->longest, count);
      if (at.x == list.stencils - 1) list.counts->listed = start[list.stencils];
    }
    if (count > kMost) return;
    const std::int32_t* own = list.order + first;
    for (int k = at.thread; k < count; k += kThreads) {
      const std::int32_t point = own[k];
      int to = first;
      for (int other = 0; other < count; ++other) to += own[other] < point;
      points.positions_mm[to] = of.model.positions_mm[point];
      points.normals[to] = of.model.normals[point];
      points.bindings[to] = of.model.bindings[point];
    }
  }
};

/// A thread per node of each stencil: the loads of the nodes.
struct LoadNodesKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  const NodeStencil* stencils;
  PointListLayout list;

  Grid blocks() const { return {blocksFor(kNodesPerPoint * list.stencils, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread, s = i / kNodesPerPoint, k = i % kNodesPerPoint;
    if (s >= list.stencils) return;
    const std::int32_t node = stencils[s][static_cast<std::size_t>(k)];
    if (node < 0) return;  // kOutsideStencil
    const FixedSum* shares = list.shares + 2 * kNodesPerPoint * s;
    if (shares[k] != 0) atomicPlus(&list.loads[node], shares[k]);
    if (shares[kNodesPerPoint + k] != 0)
      atomicPlus(&list.loads[list.nodes + node], shares[kNodesPerPoint + k]);
  }
};

}  // namespace softscope::cuda
