// cuda/match/match_search.h: kernel body of the windowed descriptor search with cross-check.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "cuda/match/match_surf.h"
#include "features/match_formulas.h"

namespace softscope::cuda {

/// Slot of a match: every square of the model nodes has at most one.
/// The raster order of squares is the order of the lists on the CPU.
struct SlotMatch {
  float model_u, model_v, live_u, live_v;
  float sigma_px, similarity;
  int found;  // 0: no match in the square
};

/// Mean shifts of squares; null: zero shift.
struct ShiftSquares {
  const float* shift_px = nullptr;  // u and v of each square
  int columns = 0, rows = 0, square_px = 1;

  SOFTSCOPE_HD void at(float u_px, float v_px, float (&shift)[2]) const {
    shift[0] = shift[1] = 0;
    if (shift_px == nullptr) return;
    const BetweenSquares across = betweenSquares(u_px, square_px, columns),
                         down = betweenSquares(v_px, square_px, rows);
    const float* upper = shift_px + 2 * down.first * columns;
    const float* lower = shift_px + 2 * down.second * columns;
    for (int axis = 0; axis < 2; ++axis)
      shift[axis] = mixSquares(upper[2 * across.first + axis], upper[2 * across.second + axis],
                               lower[2 * across.first + axis], lower[2 * across.second + axis],
                               across.share, down.share);
  }
};

/// Nodes around one, cut at the grid's ends.
struct NodeWindow {
  int c0, r0, c1, r1;  // last ones included

  SOFTSCOPE_HD static NodeWindow around(int column, int row, int reach, const SurfNodes& grid) {
    const auto low = [](int x) { return x < 0 ? 0 : x; };
    const auto high = [](int x, int count) { return x < count ? x : count - 1; };
    return {low(column - reach), low(row - reach), high(column + reach, grid.columns),
            high(row + reach, grid.rows)};
  }
  SOFTSCOPE_HD bool empty() const { return c1 < c0 || r1 < r0; }
  SOFTSCOPE_HD bool contains(int c, int r) const {
    return c >= c0 && r >= r0 && c <= c1 && r <= r1;
  }
};

/// kSquareLanes threads per square of nodes: distances of its nodes to the live nodes around
/// their predicted positions, ratio test, and cross-check for the most distinct node first.
template <int kSquareLanes>
struct SearchKernel {
  static constexpr int kGrid = DenseSurfOptions::kGridPx;
  static constexpr int kSide = MatcherOptions::kSpacingPx / kGrid;  // nodes of a square
  static constexpr int kNodes = kSide * kSide;
  static constexpr int kThreads = 256, kLanes = kSquareLanes, kSquares = kThreads / kLanes;
  static constexpr int kSearchPhases = 4, kPhases = kSearchPhases + 2 * kNodes;
  static constexpr std::uint32_t kNoKey = 0xFFFFFFFFu;
  struct Square {
    Descriptor descriptors[kNodes];
    int known[kNodes];  // node is valid
    int shift_u[kNodes], shift_v[kNodes];
    std::uint32_t best[kNodes], back[kNodes];  // (distance << 16) + place in the window
    int elsewhere[kNodes];
    float ratio[kNodes];
    int order[kNodes], count;  // nodes that pass the ratio test, most distinct first
    int done;
  };
  struct Shared {
    Square squares[kSquares];
  };
  using Local = Nothing;

  SurfNodes model, live;
  ShiftSquares predicted;
  SearchReach reach;
  int first_px;  // of the nodes, as SurfRules has it
  float max_ratio, sigma_px;
  bool whole_nodes;          // no parabola
  std::uint16_t* distances;  // model's nodes x placesPerNode()
  SlotMatch* slots;          // slotColumns() x slotRows()

  static int slotsAlong(int nodes) { return blocksFor(nodes, kSide); }
  SOFTSCOPE_HD int slotColumns() const { return (model.columns + kSide - 1) / kSide; }
  SOFTSCOPE_HD int slotRows() const { return (model.rows + kSide - 1) / kSide; }
  /// Width of the rows of a window in memory.
  static SOFTSCOPE_HD int widest(int reach, int count) {
    return 2 * reach + 1 < count ? 2 * reach + 1 : count;
  }
  static std::size_t placesPerNode(int reach, int columns, int rows) {
    return static_cast<std::size_t>(widest(reach, columns)) *
           static_cast<std::size_t>(widest(reach, rows));
  }
  Grid blocks() const { return {blocksFor(slotColumns() * slotRows(), kSquares), 1, 1}; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int slot = at.x * kSquares + at.thread / kLanes, lane = at.thread % kLanes;
    if (slot >= slotColumns() * slotRows()) return;
    Square& square = shared.squares[at.thread / kLanes];
    const int c0 = slot % slotColumns() * kSide, r0 = slot / slotColumns() * kSide;
    if constexpr (kPhase == 0) {
      begin(c0, r0, lane, square);
    } else if constexpr (kPhase == 1) {
      compare(c0, r0, lane, square);
    } else if constexpr (kPhase == 2) {
      for (int n = 0; n < kNodes; ++n) findSecondBest(c0, r0, n, lane, square);
    } else if constexpr (kPhase == 3) {
      if (lane == 0) sortByRatio(c0, r0, square);
    } else if constexpr (kPhase % 2 == 0) {
      constexpr int kTry = (kPhase - kSearchPhases) / 2;
      if (square.done == 0 && kTry < square.count)
        crossCheck(c0, r0, square.order[kTry], lane, square);
    } else {
      constexpr int kTry = (kPhase - kSearchPhases) / 2;
      if (lane == 0) decide(c0, r0, kTry, slot, square);
    }
  }

 private:
  SOFTSCOPE_HD static int columnOf(int c0, int n) { return c0 + n % kSide; }
  SOFTSCOPE_HD static int rowOf(int r0, int n) { return r0 + n / kSide; }
  SOFTSCOPE_HD float pixelOf(int node) const { return static_cast<float>(first_px + node * kGrid); }
  SOFTSCOPE_HD NodeWindow windowOf(int c0, int r0, int n, const Square& square) const {
    return NodeWindow::around(columnOf(c0, n) + square.shift_u[n], rowOf(r0, n) + square.shift_v[n],
                              reach.search, live);
  }
  SOFTSCOPE_HD std::uint16_t* distancesOf(int c0, int r0, int n) const {
    const std::size_t places = static_cast<std::size_t>(widest(reach.search, live.columns)) *
                               static_cast<std::size_t>(widest(reach.search, live.rows));
    return distances + places * static_cast<std::size_t>(model.at(columnOf(c0, n), rowOf(r0, n)));
  }
  SOFTSCOPE_HD int placeIn(const NodeWindow& window, int c, int r) const {
    return (r - window.r0) * widest(reach.search, live.columns) + c - window.c0;
  }
  SOFTSCOPE_HD int columnAt(const NodeWindow& window, std::uint32_t key) const {
    return window.c0 + static_cast<int>(key & 0xFFFFu) % widest(reach.search, live.columns);
  }
  SOFTSCOPE_HD int rowAt(const NodeWindow& window, std::uint32_t key) const {
    return window.r0 + static_cast<int>(key & 0xFFFFu) / widest(reach.search, live.columns);
  }

  SOFTSCOPE_HD void begin(int c0, int r0, int lane, Square& square) const {
    for (int i = lane; i < 4 * kNodes; i += kLanes) {
      const int n = i / 4, c = columnOf(c0, n), r = rowOf(r0, n);
      if (c < model.columns && r < model.rows)
        square.descriptors[n].quarters[i % 4] = model.descriptors[model.at(c, r)].quarters[i % 4];
    }
    if (lane == 0) square.done = square.count = 0;
    if (lane >= kNodes) return;
    const int c = columnOf(c0, lane), r = rowOf(r0, lane);
    float shift_px[2];
    predicted.at(pixelOf(c), pixelOf(r), shift_px);
    square.known[lane] =
        c < model.columns && r < model.rows && model.valid[model.at(c, r)] != 0 ? 1 : 0;
    square.shift_u[lane] = static_cast<int>(std::lround(shift_px[0] / static_cast<float>(kGrid)));
    square.shift_v[lane] = static_cast<int>(std::lround(shift_px[1] / static_cast<float>(kGrid)));
    square.best[lane] = square.back[lane] = kNoKey;
    square.elsewhere[lane] = kNoDistance;
  }

  /// All nodes of the square at once: their windows mostly overlap.
  SOFTSCOPE_HD void compare(int c0, int r0, int lane, Square& square) const {
    NodeWindow windows[kNodes], all{live.columns, live.rows, -1, -1};
    for (int n = 0; n < kNodes; ++n) {
      windows[n] = windowOf(c0, r0, n, square);
      if (square.known[n] == 0) windows[n] = {0, 0, -1, -1};
      if (windows[n].empty()) continue;
      all.c0 = windows[n].c0 < all.c0 ? windows[n].c0 : all.c0;
      all.r0 = windows[n].r0 < all.r0 ? windows[n].r0 : all.r0;
      all.c1 = windows[n].c1 > all.c1 ? windows[n].c1 : all.c1;
      all.r1 = windows[n].r1 > all.r1 ? windows[n].r1 : all.r1;
    }
    if (all.empty()) return;
    std::uint32_t best[kNodes];
    for (int n = 0; n < kNodes; ++n) best[n] = kNoKey;
    const int width = all.c1 - all.c0 + 1, count = width * (all.r1 - all.r0 + 1);
    for (int i = lane; i < count; i += kLanes) {
      const int c = all.c0 + i % width, r = all.r0 + i / width;
      const int node = live.at(c, r);
      const bool valid = live.valid[node] != 0;
      std::uint32_t sums[kNodes] = {};
      if (valid)
        for (int q = 0; q < 4; ++q) {
          const Descriptor::Quarter quarter = live.descriptors[node].quarters[q];
          for (int n = 0; n < kNodes; ++n)
            sums[n] = quarterDistance(square.descriptors[n].quarters[q], quarter, sums[n]);
        }
      for (int n = 0; n < kNodes; ++n) {
        if (!windows[n].contains(c, r)) continue;
        const int place = placeIn(windows[n], c, r);
        distancesOf(c0, r0, n)[place] = static_cast<std::uint16_t>(valid ? sums[n] : kNoDistance);
        const std::uint32_t key = sums[n] << 16 | static_cast<std::uint32_t>(place);
        if (valid && key < best[n]) best[n] = key;
      }
    }
    for (int n = 0; n < kNodes; ++n)
      if (best[n] != kNoKey) atomicLeast(&square.best[n], best[n]);
  }

  /// Smallest distance of nodes outside of the reach around the best one.
  SOFTSCOPE_HD void findSecondBest(int c0, int r0, int n, int lane, Square& square) const {
    if (square.best[n] == kNoKey) return;
    const NodeWindow window = windowOf(c0, r0, n, square);
    const int column = columnAt(window, square.best[n]), row = rowAt(window, square.best[n]);
    const std::uint16_t* from = distancesOf(c0, r0, n);
    const int width = window.c1 - window.c0 + 1, count = width * (window.r1 - window.r0 + 1);
    int least = kNoDistance;
    for (int i = lane; i < count; i += kLanes) {
      const int c = window.c0 + i % width, r = window.r0 + i / width;
      if (isNear(c - column, reach.elsewhere) && isNear(r - row, reach.elsewhere)) continue;
      const int distance = from[placeIn(window, c, r)];
      least = distance < least ? distance : least;
    }
    if (least != kNoDistance) atomicLeast(&square.elsewhere[n], least);
  }
  SOFTSCOPE_HD static bool isNear(int apart, int reach) {
    return apart >= -reach && apart <= reach;
  }

  /// Equal ratios remain in raster order.
  SOFTSCOPE_HD void sortByRatio(int c0, int r0, Square& square) const {
    for (int n = 0; n < kNodes; ++n) {
      if (square.best[n] == kNoKey || isAtRim(c0, r0, n, square)) continue;
      const float ratio =
          distanceRatio(static_cast<int>(square.best[n] >> 16), square.elsewhere[n]);
      if (!(ratio < max_ratio)) continue;
      square.ratio[n] = ratio;
      int k = square.count++;
      for (; k > 0 && ratio < square.ratio[square.order[k - 1]]; --k)
        square.order[k] = square.order[k - 1];
      square.order[k] = n;
    }
  }

  SOFTSCOPE_HD bool isAtRim(int c0, int r0, int n, const Square& square) const {
    const NodeWindow window = windowOf(c0, r0, n, square);
    return reach.isAtRim(columnAt(window, square.best[n]) - columnOf(c0, n) - square.shift_u[n],
                         rowAt(window, square.best[n]) - rowOf(r0, n) - square.shift_v[n]);
  }

  /// Best node of the model around the predicted origin of the live node.
  SOFTSCOPE_HD void crossCheck(int c0, int r0, int n, int lane, Square& square) const {
    const NodeWindow there = windowOf(c0, r0, n, square);
    const int column = columnAt(there, square.best[n]), row = rowAt(there, square.best[n]);
    const Descriptor one = live.descriptors[live.at(column, row)];
    const NodeWindow window = NodeWindow::around(column - square.shift_u[n],
                                                 row - square.shift_v[n], reach.search, model);
    if (window.empty()) return;
    const int width = window.c1 - window.c0 + 1, count = width * (window.r1 - window.r0 + 1);
    std::uint32_t best = kNoKey;
    for (int i = lane; i < count; i += kLanes) {
      const int c = window.c0 + i % width, r = window.r0 + i / width, node = model.at(c, r);
      if (model.valid[node] == 0) continue;
      std::uint32_t sum = 0;
      for (int q = 0; q < 4; ++q)
        sum = quarterDistance(one.quarters[q], model.descriptors[node].quarters[q], sum);
      const std::uint32_t key = sum << 16 | static_cast<std::uint32_t>(placeIn(window, c, r));
      best = key < best ? key : best;
    }
    if (best != kNoKey) atomicLeast(&square.back[n], best);
  }

  SOFTSCOPE_HD void decide(int c0, int r0, int k, int slot, Square& square) const {
    if (square.done != 0) return;
    if (k < square.count && isMutual(c0, r0, square.order[k], square)) {
      square.done = 1;
      store(c0, r0, square.order[k], slot, square);
    } else if (k + 1 == kNodes) {
      slots[slot] = {0, 0, 0, 0, 0, 0, 0};
    }
  }
  SOFTSCOPE_HD bool isMutual(int c0, int r0, int n, const Square& square) const {
    if (square.back[n] == kNoKey) return false;
    const NodeWindow there = windowOf(c0, r0, n, square);
    const NodeWindow window =
        NodeWindow::around(columnAt(there, square.best[n]) - square.shift_u[n],
                           rowAt(there, square.best[n]) - square.shift_v[n], reach.search, model);
    return isNear(columnAt(window, square.back[n]) - columnOf(c0, n), reach.mutual) &&
           isNear(rowAt(window, square.back[n]) - rowOf(r0, n), reach.mutual);
  }
  SOFTSCOPE_HD void store(int c0, int r0, int n, int slot, const Square& square) const {
    const NodeWindow window = windowOf(c0, r0, n, square);
    const int c = columnAt(window, square.best[n]), r = rowAt(window, square.best[n]);
    SlotMatch match{
        pixelOf(columnOf(c0, n)), pixelOf(rowOf(r0, n)), pixelOf(c), pixelOf(r), sigma_px, 0, 1};
    if (!whole_nodes) {
      const std::uint16_t* from = distancesOf(c0, r0, n);
      const int best = static_cast<int>(square.best[n] >> 16);
      const auto distance = [&](int x, int y) -> int {
        return window.contains(x, y) ? from[placeIn(window, x, y)] : kNoDistance;
      };
      match.live_u +=
          static_cast<float>(kGrid) * parabolaShift(distance(c - 1, r), best, distance(c + 1, r));
      match.live_v +=
          static_cast<float>(kGrid) * parabolaShift(distance(c, r - 1), best, distance(c, r + 1));
    }
    slots[slot] = match;
  }
};

}  // namespace softscope::cuda
