// cuda/match/match_select.h: kernel bodies of match selection: error limit, consistency, matches of
// coarser levels, and predicted shifts.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "cuda/match/match_images.h"
#include "cuda/match/match_search.h"
#include "features/match_formulas.h"

namespace softscope::cuda {

/// One call of `body(slot)` per slot.
template <class Body>
struct SlotKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  Body body;
  int count;

  Grid blocks() const { return {blocksFor(count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int slot = at.x * kThreads + at.thread;
    if (slot < count) body(slot);
  }
};

struct CopyMatchesBody {
  const SlotMatch* from;
  SlotMatch* to;
  SOFTSCOPE_HD void operator()(int slot) const { to[slot] = from[slot]; }
};

/// Larger one of `least` and the median error of a level;
/// one block per level. Radix selection, 8 bits per round.
struct SigmaLimitKernel {
  static constexpr int kThreads = 1024, kPhases = 4, kBins = 256, kGroup = 16;
  struct Shared {
    int bins[kBins], groups[kBins / kGroup];
    std::uint32_t prefix;
    int rank;
  };
  using Local = Nothing;
  const SlotMatch* matches[kMostMatchLevels];
  int counts[kMostMatchLevels];
  float least;
  float* limits;

  SOFTSCOPE_HD int repeats(const Place&) const { return 4; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int shift = 24 - 8 * at.repeat;
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < kBins; i += kThreads) shared.bins[i] = 0;
      if (at.thread == 0 && at.repeat == 0) shared.prefix = 0;
    } else if constexpr (kPhase == 1) {
      const SlotMatch* level = matches[at.x];
      for (int i = at.thread; i < counts[at.x]; i += kThreads) {
        if (level[i].found == 0) continue;
        const std::uint32_t bits = floatAsBits(level[i].sigma_px);
        // 64 bits: the first round shifts by 32.
        if (static_cast<std::uint64_t>(bits ^ shared.prefix) >> (shift + 8) != 0) continue;
        atomicPlus(&shared.bins[bits >> shift & 255u], 1);
      }
    } else if constexpr (kPhase == 2) {
      if (at.thread >= kBins / kGroup) return;
      int sum = 0;
      for (int k = 0; k < kGroup; ++k) sum += shared.bins[at.thread * kGroup + k];
      shared.groups[at.thread] = sum;
    } else if (at.thread == 0) {
      choose(at, shift, shared);
    }
  }

 private:
  SOFTSCOPE_HD void choose(const Place& at, int shift, Shared& shared) const {
    if (at.repeat == 0) {
      int total = 0;
      for (const int sum : shared.groups) total += sum;
      shared.rank = total / 2;
    }
    int group = 0;
    while (group + 1 < kBins / kGroup && shared.rank >= shared.groups[group])
      shared.rank -= shared.groups[group++];
    int bin = group * kGroup;
    while (bin + 1 < (group + 1) * kGroup && shared.rank >= shared.bins[bin])
      shared.rank -= shared.bins[bin++];
    shared.prefix |= static_cast<std::uint32_t>(bin) << shift;
    if (shift > 0) return;
    const float median = bitsAsFloat(shared.prefix);
    limits[at.x] = least < median ? median : least;
  }
};

/// What matches occupy the squares of an image.
enum SquareState : std::uint8_t { kSquareFree, kSquareHasGood, kSquareHasKept };
struct TakenSquares {
  std::uint8_t* states;  // free at first
  int columns, square_px;
  SOFTSCOPE_HD std::uint8_t& of(const SlotMatch& match) const {
    return states[static_cast<int>(match.model_v) / square_px * columns +
                  static_cast<int>(match.model_u) / square_px];
  }
};

/// One level's slots.
struct MatchSlots {
  const SlotMatch* matches;
  SlotMatch* kept;
  int columns, rows;
  TakenSquares squares;
};

/// Marks the squares with matches within the limit of their level; z: level.
struct GoodSquaresKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  MatchSlots levels[kMostMatchLevels];
  const float* sigma_limits;  // per level

  Grid blocks(int level_count) const {
    return {blocksFor(levels[0].columns * levels[0].rows, kThreads), 1, level_count};
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const MatchSlots& slots = levels[at.z];
    const int slot = at.x * kThreads + at.thread;
    if (slot >= slots.columns * slots.rows) return;
    const SlotMatch& match = slots.matches[slot];
    if (match.found != 0 && !(match.sigma_px > sigma_limits[at.z]))
      slots.squares.of(match) = kSquareHasGood;
  }
};

/// Keeps matches that are consistent with their neighbours and within the error limit, or
/// within that of matches without better ones in their square; z: level.
struct ConsistentKernel {
  static constexpr int kWidth = 16, kHeight = 8, kThreads = kWidth * kHeight, kPhases = 2;
  static constexpr int kSlotPx = MatcherOptions::kSpacingPx;
  /// Nodes of two squares are up to kSlotPx - kGridPx nearer than the squares.
  static constexpr int kReach =
      static_cast<int>(ConsistencyOptions::kReachPx + kSlotPx - DenseSurfOptions::kGridPx) /
      kSlotPx;
  static constexpr int kColumns = kWidth + 2 * kReach, kRows = kHeight + 2 * kReach;
  struct Shared {
    float model_u[kRows][kColumns], model_v[kRows][kColumns];
    float live_u[kRows][kColumns], live_v[kRows][kColumns];
    int counts[kRows][kColumns];
  };
  using Local = Nothing;
  MatchSlots levels[kMostMatchLevels];
  const float* sigma_limits;  // per level; null: none
  float lone_limit_px;
  ConsistencyRules rules;

  Grid blocks(int level_count) const {
    return {blocksFor(levels[0].columns, kWidth), blocksFor(levels[0].rows, kHeight), level_count};
  }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const MatchSlots& slots = levels[at.z];
    const int c0 = at.x * kWidth, r0 = at.y * kHeight;
    if (c0 >= slots.columns || r0 >= slots.rows) return;
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < kColumns * kRows; i += kThreads)
        load(slots, at.z, c0, r0, i % kColumns, i / kColumns, shared);
    } else {
      const int x = at.thread % kWidth, y = at.thread / kWidth;
      if (c0 + x >= slots.columns || r0 + y >= slots.rows) return;
      const int slot = (r0 + y) * slots.columns + c0 + x;
      SlotMatch match = slots.matches[slot];
      match.found = isKept(x + kReach, y + kReach, shared) ? 1 : 0;
      slots.kept[slot] = match;
    }
  }

 private:
  SOFTSCOPE_HD void load(const MatchSlots& slots, int level, int c0, int r0, int x, int y,
                         Shared& shared) const {
    const int c = c0 + x - kReach, r = r0 + y - kReach;
    const bool inside = c >= 0 && r >= 0 && c < slots.columns && r < slots.rows;
    shared.counts[y][x] = 0;
    if (!inside) return;
    const SlotMatch& match = slots.matches[r * slots.columns + c];
    if (match.found == 0) return;
    shared.model_u[y][x] = match.model_u;
    shared.model_v[y][x] = match.model_v;
    shared.live_u[y][x] = match.live_u;
    shared.live_v[y][x] = match.live_v;
    shared.counts[y][x] =
        sigma_limits == nullptr || !(match.sigma_px > sigma_limits[level]) || isLone(slots, match)
            ? 1
            : 0;
  }
  SOFTSCOPE_HD bool isLone(const MatchSlots& slots, const SlotMatch& match) const {
    return match.sigma_px <= lone_limit_px && slots.squares.of(match) == kSquareFree;
  }
  SOFTSCOPE_HD bool isKept(int x, int y, const Shared& shared) const {
    if (shared.counts[y][x] == 0) return false;
    int others = 0, agreeing = 0;
    for (int r = y - kReach; r <= y + kReach; ++r)
      for (int c = x - kReach; c <= x + kReach; ++c) {
        if (shared.counts[r][c] == 0 || (r == y && c == x)) continue;
        const float u = shared.model_u[r][c] - shared.model_u[y][x],
                    v = shared.model_v[r][c] - shared.model_v[y][x];
        if (!areNeighbours(u, v, rules)) continue;
        ++others;
        agreeing += moveConsistently(u, v, shared.live_u[r][c] - shared.live_u[y][x],
                                     shared.live_v[r][c] - shared.live_v[y][x], rules)
                        ? 1
                        : 0;
      }
    return isConsistent(agreeing, others, rules);
  }
};

// --- coarser levels ------------------------------------------------------------------------------

struct TakeSquaresBody {
  const SlotMatch* matches;
  TakenSquares squares;
  SOFTSCOPE_HD void operator()(int slot) const {
    const SlotMatch& match = matches[slot];
    if (match.found != 0) squares.of(match) = kSquareHasKept;
  }
};
/// Coarser matches in pixels of this level, without those in occupied squares.
struct FromCoarserBody {
  SlotMatch* matches;
  TakenSquares squares;
  SOFTSCOPE_HD void operator()(int slot) const {
    SlotMatch match = matches[slot];
    match.model_u = toFinerPx(match.model_u);
    match.model_v = toFinerPx(match.model_v);
    match.live_u = toFinerPx(match.live_u);
    match.live_v = toFinerPx(match.live_v);
    match.sigma_px *= 2;
    if (match.found != 0 && squares.of(match) == kSquareHasKept) match.found = 0;
    matches[slot] = match;
  }
};

// --- predicted shifts ----------------------------------------------------------------------------

struct ShiftSum {
  float u, v, count;
};
/// Levels of the push-pull interpolation, the finest first.
struct ShiftPyramid {
  static constexpr int kMostLevels = 16;
  ShiftSum* sums[kMostLevels];
  float* means[kMostLevels];  // u and v
  int columns[kMostLevels], rows[kMostLevels];
  int count;
};

/// Sums of the shifts in squares of the next finer level, in the order of the slots.
struct SumShiftsBody {
  const SlotMatch* matches;
  int columns, rows;  // slots
  int first_px;       // of the first node
  ShiftPyramid pyramid;
  int square_px;

  SOFTSCOPE_HD void operator()(int column, int row, int) const {
    ShiftSum sum{0, 0, 0};
    for (int r = firstSlot(row); r <= lastSlot(row, pyramid.rows[0], rows); ++r)
      for (int c = firstSlot(column); c <= lastSlot(column, pyramid.columns[0], columns); ++c) {
        const SlotMatch& match = matches[r * columns + c];
        if (match.found == 0) continue;
        const float u = toFinerPx(match.model_u), v = toFinerPx(match.model_v);
        if (squareOf(u, square_px, pyramid.columns[0]) != column ||
            squareOf(v, square_px, pyramid.rows[0]) != row)
          continue;
        sum.u += toFinerPx(match.live_u) - u;
        sum.v += toFinerPx(match.live_v) - v;
        sum.count += 1;
      }
    pyramid.sums[0][row * pyramid.columns[0] + column] = sum;
  }

 private:
  static constexpr int kSlotPx = MatcherOptions::kSpacingPx;
  /// Slots whose matches may be in a square, with a margin for rounding.
  SOFTSCOPE_HD int firstSlot(int square) const {
    const int slot = (square * square_px / 2 - first_px) / kSlotPx - 1;
    return slot < 0 ? 0 : slot;
  }
  SOFTSCOPE_HD int lastSlot(int square, int squares, int slots) const {
    const int slot = ((square + 1) * square_px / 2 - first_px) / kSlotPx + 1;
    return square + 1 < squares && slot < slots ? slot : slots - 1;
  }
};

/// Sums from fine to coarse, then means from coarse to fine; one block.
struct FillShiftsKernel {
  static constexpr int kThreads = 1024, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  ShiftPyramid pyramid;

  SOFTSCOPE_HD int repeats(const Place&) const { return 2 * pyramid.count - 1; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const bool up = at.repeat + 1 < pyramid.count;
    const int k = up ? at.repeat + 1 : 2 * (pyramid.count - 1) - at.repeat;
    for (int i = at.thread; i < pyramid.columns[k] * pyramid.rows[k]; i += kThreads) {
      const int column = i % pyramid.columns[k], row = i / pyramid.columns[k];
      if (up)
        pyramid.sums[k][i] = sumOfFiner(k - 1, column, row);
      else
        fill(k, i, column, row);
    }
  }

 private:
  SOFTSCOPE_HD ShiftSum sumOfFiner(int k, int column, int row) const {
    ShiftSum sum{0, 0, 0};
    for (int y = 2 * row; y < 2 * row + 2 && y < pyramid.rows[k]; ++y)
      for (int x = 2 * column; x < 2 * column + 2 && x < pyramid.columns[k]; ++x) {
        const ShiftSum& finer = pyramid.sums[k][y * pyramid.columns[k] + x];
        sum.u += finer.u;
        sum.v += finer.v;
        sum.count += finer.count;
      }
    return sum;
  }
  SOFTSCOPE_HD void fill(int k, int i, int column, int row) const {
    const ShiftSum& sum = pyramid.sums[k][i];
    float u = 0, v = 0;
    if (sum.count > 0) {
      u = sum.u / sum.count;
      v = sum.v / sum.count;
    } else if (k + 1 < pyramid.count) {
      const float* coarser =
          pyramid.means[k + 1] + 2 * (row / 2 * pyramid.columns[k + 1] + column / 2);
      u = coarser[0];
      v = coarser[1];
    }
    pyramid.means[k][2 * i] = u;
    pyramid.means[k][2 * i + 1] = v;
  }
};

}  // namespace softscope::cuda
