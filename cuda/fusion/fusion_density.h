// cuda/fusion/fusion_density.h: kernel bodies that leave one point per cell and side of the
// surface.
#pragma once

#include "cuda/fusion/fusion_cells.h"
#include "cuda/fusion/fusion_layout.h"
#include "fusion/density_formulas.h"
#include "fusion/density_grid.h"

namespace softscope::cuda {

/// The model with its new points.
struct DensePoints {
  ModelArrays model;
  int model_count, most;  // before, and at most with new points
  const FusionCounts* counts;
  FusionPointLayout points;

  SOFTSCOPE_HD int count() const { return model_count + counts->inserted; }
  Grid blocks(int threads) const { return {blocksFor(most, threads), 1, 1}; }
};

/// A thread per point: its cell, and how many points the cell has.
struct CellsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  DensePoints all;
  PosedCamera camera;
  float cell_mm;
  CellSlots cells;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= all.count()) return;
    const ModelArrays& model = all.model;
    const CellKey key = isKeptInModel(model.normals[i], model.weights[i])
                            ? densityCell(model.positions_mm[i], camera, cell_mm)
                            : kNoCell;
    const std::int32_t slot = key == kNoCell ? -1 : cells.take(key);
    all.points.slots[i] = slot;
    if (slot >= 0) atomicPlus(&all.points.values[slot], 1u);
  }
};

/// A thread per slot: room for the cell's points. Which room depends on the order of threads, what
/// is in it does not.
struct CellRoomKernel {
  static constexpr int kThreads = 256, kPhases = 4;
  struct Shared {
    int points, begin;
  };
  struct Local {
    int within;
  };
  FusionPointLayout points;
  FusionCounts* counts;

  Grid blocks() const { return {static_cast<int>(points.slot_count) / kThreads + 1, 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const std::size_t slot = static_cast<std::size_t>(at.x * kThreads + at.thread);
    const int count = slot < points.slot_count ? static_cast<int>(points.values[slot]) : 0;
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.points = 0;
    } else if constexpr (kPhase == 1) {
      local.within = count > 0 ? atomicPlus(&shared.points, count) : 0;
    } else if constexpr (kPhase == 2) {
      if (at.thread == 0)
        shared.begin = shared.points > 0 ? atomicPlus(&counts->listed, shared.points) : 0;
    } else {
      if (count > 0) points.ends[slot] = shared.begin + local.within;  // filled from here on
    }
  }
};

/// After CellRoomKernel, a thread per point: lists the points of each cell, in any order.
struct ListCellsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  DensePoints all;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= all.count()) return;
    const std::int32_t slot = all.points.slots[i];
    all.points.heirs[i] = slot < 0 ? IndexMap::kRemoved : i;
    if (slot >= 0) all.points.order[atomicPlus(&all.points.ends[slot], 1)] = i;
  }
};

/// After ListCellsKernel, a thread per slot: merges the cell's points, in the model's order.
struct MergeCellsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ModelArrays model;
  FusionPointLayout points;
  float least_cosine;

  Grid blocks() const { return {static_cast<int>(points.slot_count) / kThreads + 1, 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const std::size_t slot = static_cast<std::size_t>(at.x * kThreads + at.thread);
    if (slot >= points.slot_count || points.values[slot] < 2) return;
    const int count = static_cast<int>(points.values[slot]);
    std::int32_t* own = points.order + points.ends[slot] - count;
    sortAscending(own, count);
    int held = 0;  // those that stay are the list's beginning
    for (int k = 0; k < count; ++k) add(own[k], own, &held);
  }

 private:
  SOFTSCOPE_HD void add(std::int32_t i, std::int32_t* own, int* held) const {
    int k = 0;
    while (k < *held && !onSameSide(model.normals[own[k]], model.normals[i], least_cosine)) ++k;
    if (k == *held) {
      own[(*held)++] = i;
    } else if (model.weights[i] > model.weights[own[k]]) {
      merge(own[k], i);
      own[k] = i;
    } else {
      merge(i, own[k]);
    }
  }
  SOFTSCOPE_HD void merge(std::int32_t other, std::int32_t survivor) const {
    ModelPoint merged = model.at(survivor);
    mergeInto(model.at(other), &merged);
    model.set(survivor, merged);
    PointBinding& binding = model.bindings[survivor];
    if (!binding.bound()) binding = model.bindings[other];
    points.heirs[other] = survivor;
  }
};

/// For putInOrder(), after MergeCellsKernel: points that stay move to `to`, in their order.
struct StayingPoints {
  DensePoints all;
  ModelArrays to;

  int capacity() const { return all.most; }
  SOFTSCOPE_HD int count() const { return all.count(); }
  SOFTSCOPE_HD bool chosen(int i) const { return all.points.heirs[i] == i; }
  SOFTSCOPE_HD void put(int i, int place) const {
    to.set(place, all.model.at(i));
    to.bindings[place] = all.model.bindings[i];
    all.points.new_of_old[i] = place;
  }
};

/// After that, a thread per point: where those went that did not stay.
struct HeirsKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  DensePoints all;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= all.count()) return;
    const std::int32_t* heirs = all.points.heirs;
    std::int32_t last = heirs[i];
    if (last == i) return;
    while (last != IndexMap::kRemoved && heirs[last] != last) last = heirs[last];
    all.points.new_of_old[i] =
        last == IndexMap::kRemoved ? IndexMap::kRemoved : all.points.new_of_old[last];
  }
};

}  // namespace softscope::cuda
