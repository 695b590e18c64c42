// cuda/view/view_discs.h: kernel bodies of discs from model points, listed by image tile.
#pragma once

#include "core/image.h"
#include "cuda/device/kernel.h"
#include "features/view_formulas.h"

namespace softscope::cuda {

/// The points of a model.
struct ModelPoints {
  const ViewVector *positions_mm, *normals;
  const Rgb8* colours;
  const std::uint8_t* anchors;
};

/// Square tiles of the image and their lists of discs.
struct DiscTiles {
  static constexpr int kSide = 8;
  /// A disc spans at most 26 columns, a rounded one among them, and 25 rows: 5 x 4 tiles.
  static constexpr int kMostOfDisc = 20;
  int width = 0, height = 0, columns = 0, rows = 0;
  int* counts = nullptr;   // per tile, 0 at first
  int* cursors = nullptr;  // per tile, 0 at first
  int* starts = nullptr;   // per tile and one more, in the lists
  int *entries = nullptr, *sorted = nullptr;

  SOFTSCOPE_HD int count() const { return columns * rows; }

  /// Calls visit(tile) for every tile that contains pixels of a disc.
  template <class Visit>
  SOFTSCOPE_HD void forEachTile(const SplatDisc& disc, const Visit& visit) const {
    const DiscBox box = discBox(disc);
    // Pixels of the groups beyond the radius do not belong to the disc.
    const int last_of_groups = box.u0 + box.groups * kSplatLanes - 1;
    const int last_of_disc = floorOf(disc.u_px + disc.radius_px) + 1;
    const int u0 = larger(box.u0, 0), v0 = larger(box.v0, 0);
    const int u1 = smaller(smaller(last_of_groups, last_of_disc), width - 1);
    const int v1 = smaller(box.v1, height - 1);
    if (u1 < u0 || v1 < v0) return;
    for (int y = v0 / kSide; y <= v1 / kSide; ++y)
      for (int x = u0 / kSide; x <= u1 / kSide; ++x) visit(y * columns + x);
  }

 private:
  SOFTSCOPE_HD static int larger(int a, int b) { return a > b ? a : b; }
  SOFTSCOPE_HD static int smaller(int a, int b) { return a < b ? a : b; }
};

/// One thread per point.
struct PlaceDiscsKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ModelPoints points;
  int capacity;
  const int* count;
  const ViewProjector* camera;
  SplatDisc* discs;  // radius 0: not drawn
  DiscTiles tiles;

  Grid blocks() const { return {blocksFor(capacity, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= *count) return;
    SplatDisc disc{};
    if (placeDisc(*camera, points.positions_mm[i], points.normals[i], &disc)) {
      const Rgb8 colour = points.colours[i];
      disc.red = colour.red;
      disc.green = colour.green;
      disc.blue = colour.blue;
      disc.anchor = points.anchors[i];
      disc.point = i;
      tiles.forEachTile(disc, [&](int tile) { atomicPlus(&tiles.counts[tile], 1); });
    } else {
      disc.radius_px = 0;
    }
    discs[i] = disc;
  }
};

/// Start of the list of each tile; one block, kThreads tiles at a time.
struct TileStartsKernel {
  static constexpr int kThreads = 1024, kPhases = 4, kParts = 32;
  struct Shared {
    int counts[kThreads + kParts];  // a gap after each part, against bank conflicts
    int parts[kParts], total;
  };
  using Local = Nothing;
  DiscTiles tiles;

  SOFTSCOPE_HD int repeats(const Place&) const { return (tiles.count() + kThreads - 1) / kThreads; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int tile = at.repeat * kThreads + at.thread;
    constexpr int kEach = kThreads / kParts;
    if constexpr (kPhase == 0) {
      shared.counts[padded(at.thread)] = tile < tiles.count() ? tiles.counts[tile] : 0;
      if (at.thread == 0 && at.repeat == 0) shared.total = 0;
    } else if constexpr (kPhase == 1) {
      if (at.thread >= kParts) return;
      int sum = 0;
      for (int k = at.thread * kEach; k < (at.thread + 1) * kEach; ++k) {
        const int own = shared.counts[padded(k)];
        shared.counts[padded(k)] = sum;
        sum += own;
      }
      shared.parts[at.thread] = sum;
    } else if constexpr (kPhase == 2) {
      if (at.thread != 0) return;
      for (int& part : shared.parts) {
        const int own = part;
        part = shared.total;
        shared.total += own;
      }
    } else {
      if (tile < tiles.count())
        tiles.starts[tile] = shared.parts[at.thread / kEach] + shared.counts[padded(at.thread)];
      if (tile == tiles.count() - 1) tiles.starts[tile + 1] = shared.total;
    }
  }

 private:
  SOFTSCOPE_HD static int padded(int k) { return k + k / (kThreads / kParts); }
};

/// One thread per point; the order within a list is that of the threads.
struct ListDiscsKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  const SplatDisc* discs;
  int capacity;
  const int* count;
  DiscTiles tiles;

  Grid blocks() const { return {blocksFor(capacity, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= *count || !(discs[i].radius_px > 0)) return;
    tiles.forEachTile(discs[i], [&](int tile) {
      tiles.entries[tiles.starts[tile] + atomicPlus(&tiles.cursors[tile], 1)] = i;
    });
  }
};

/// Each list in the order of the points; one block per tile, rank by counting.
struct SortDiscsKernel {
  static constexpr int kThreads = 64, kPhases = 3;
  struct Shared {
    int entries[kThreads];
  };
  struct Local {
    int entry, place;
  };
  DiscTiles tiles;

  Grid blocks() const { return {tiles.count(), 1, 1}; }
  SOFTSCOPE_HD int chunks(const Place& at) const {
    return (tiles.starts[at.x + 1] - tiles.starts[at.x] + kThreads - 1) / kThreads;
  }
  SOFTSCOPE_HD int repeats(const Place& at) const { return chunks(at) * chunks(at); }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const int start = tiles.starts[at.x], count = tiles.starts[at.x + 1] - start;
    const int own = at.repeat / chunks(at) * kThreads + at.thread;
    const int others = at.repeat % chunks(at) * kThreads;
    if constexpr (kPhase == 0) {
      const int other = others + at.thread;
      shared.entries[at.thread] = other < count ? tiles.entries[start + other] : 0x7FFFFFFF;
      if (others > 0) return;
      local.entry = own < count ? tiles.entries[start + own] : 0;
      local.place = 0;
    } else if constexpr (kPhase == 1) {
      for (const int other : shared.entries) local.place += other < local.entry ? 1 : 0;
    } else {
      if (others + kThreads >= count && own < count)
        tiles.sorted[start + local.place] = local.entry;
    }
  }
};

}  // namespace softscope::cuda
