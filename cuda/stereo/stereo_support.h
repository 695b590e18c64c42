// cuda/stereo/stereo_support.h: kernel bodies of support points from grey images.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_ignored.h"
#include "stereo/kernels/matching_formulas.h"

namespace softscope::cuda {

/// Packed gradients with a flat margin on every side, as in GradientImage.
struct GradientPlane {
  static constexpr std::uint8_t kFlatByte = 0x80;  // every byte of the margin
  static constexpr int kRowMargin = 4;

  std::uint16_t* origin = nullptr;  // pixel (0, 0)
  int stride = 0;                   // even, and the origin lies at an even place

  SOFTSCOPE_HD std::uint16_t* at(int u, int v) const {
    return origin + static_cast<std::ptrdiff_t>(v) * stride + u;
  }
  static constexpr int sideMargin(int disparity_max_px) {
    return (disparity_max_px + 2 * kTileWidth + 63) / 64 * 64;
  }
};

struct GradientBody {
  View<const std::uint8_t> gray[2];
  GradientPlane out[2];
  int gain_q8;

  SOFTSCOPE_HD void operator()(int u, int v, int view) const {
    const View<const std::uint8_t>& image = gray[view];
    const int last_u = image.width - 1, last_v = image.height - 1;
    *out[view].at(u, v) = packedGradient(image.row(v > 0 ? v - 1 : 0), image.row(v),
                                         image.row(v < last_v ? v + 1 : last_v), u > 0 ? u - 1 : 0,
                                         u, u < last_u ? u + 1 : last_u, gain_q8);
  }
};

struct DisparityRange {
  int first, last;
};

/// Grid of support points with their tests; fields as in ElasOptions.
struct SupportGrid {
  int width, height;  // of the image
  int step, columns, rows;
  DisparityRange range;  // of the options
  double texture, uniqueness;
  int left_right_px, window_cells, agreement_px, min_neighbours;

  SOFTSCOPE_HD bool hasRow(int r) const {
    return r < rows && r * step >= kSupportMargin && r * step < height - kSupportMargin;
  }
  SOFTSCOPE_HD int count() const { return range.last - range.first + 1; }
};

/// Every fourth row of the grid, tried over the whole range; the others over the range found there.
struct SupportPass {
  const DisparityRange* narrowed = nullptr;  // null: the first pass

  static_assert(kRangeRows == 4, "rowOf() and its inverse");
  SOFTSCOPE_HD int rowOf(int y) const {
    if (narrowed == nullptr) return 4 * y + 1;
    return y / 3 * 4 + (y % 3 == 0 ? 0 : y % 3 + 1);
  }
  int rowCount(int rows) const { return narrowed == nullptr ? (rows + 2) / 4 : rows; }
  SOFTSCOPE_HD DisparityRange range(const SupportGrid& grid) const {
    return narrowed == nullptr ? grid.range : *narrowed;
  }
};

/// Smallest costs of a row as (cost << 16) + disparity: ties prefer the smaller disparity.
constexpr std::uint32_t kNoCost = 0xFFFFFFFFu;

struct SupportCosts {
  std::uint32_t *best_left, *best_right;  // rows x width
  std::uint16_t* volume;                  // rows x columns x count
};

/// One block: one row of the grid, kThreads columns, kDisparities disparities.
struct SupportCostKernel {
  static constexpr int kThreads = 256, kDisparities = 32, kAtATime = 8, kPhases = 10;
  static constexpr int kMargin = kSupportMargin;
  static constexpr int kLeft = kThreads + 2 * kMargin, kRight = kLeft + kDisparities - 1;
  struct Shared {
    std::uint32_t left[3][kLeft], right[3][kRight];  // two rows a word; the last row alone
    std::uint32_t sums[kAtATime / 2][kLeft];         // of columns, two disparities a word
    std::uint32_t best_right[kThreads + kDisparities - 1];
  };
  struct Local {
    std::uint32_t best;
  };
  SupportGrid grid;
  SupportPass pass;
  GradientPlane left, right;
  SupportCosts out;

  Grid blocks() const {
    return {blocksFor(grid.width, kThreads), pass.rowCount(grid.rows),
            blocksFor(grid.count(), kDisparities)};
  }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const int r = pass.rowOf(at.y), u0 = at.x * kThreads;
    const DisparityRange range = pass.range(grid);
    const int first = range.first + at.z * kDisparities;
    if (!grid.hasRow(r) || first > range.last) return;
    if constexpr (kPhase == 0) {
      load(at.thread, r * grid.step, u0, first, shared);
      local.best = kNoCost;
    } else if constexpr (kPhase == kPhases - 1) {
      store(at.thread, r, u0, first, shared, local);
    } else if constexpr (kPhase % 2 == 1) {
      sumColumns(at.thread, kPhase / 2 * kAtATime, shared);
    } else {
      addCosts(at.thread, r, u0, first, range.last, (kPhase - 1) / 2 * kAtATime, shared, local);
    }
  }

 private:
  /// Two rows of column c in a word; flat outside of the margin.
  SOFTSCOPE_HD void loadColumn(const GradientPlane& plane, int c, int v,
                               std::uint32_t (&words)[3]) const {
    const bool inside = c < grid.width + kMargin;
    const auto pixel = [&](int dy) -> std::uint32_t {
      return inside ? *plane.at(c, v + dy) : 0x8080u;
    };
    words[0] = pixel(-4) | pixel(-2) << 16;
    words[1] = pixel(0) | pixel(2) << 16;
    words[2] = pixel(4);
  }
  SOFTSCOPE_HD void load(int thread, int v, int u0, int first, Shared& shared) const {
    std::uint32_t words[3];
    for (int i = thread; i < kLeft; i += kThreads) {
      loadColumn(left, u0 - kMargin + i, v, words);
      for (int k = 0; k < 3; ++k) shared.left[k][i] = words[k];
    }
    for (int i = thread; i < kRight; i += kThreads) {
      loadColumn(right, u0 - kMargin - (first + kDisparities - 1) + i, v, words);
      for (int k = 0; k < 3; ++k) shared.right[k][i] = words[k];
    }
    for (int i = thread; i < kThreads + kDisparities - 1; i += kThreads)
      shared.best_right[i] = kNoCost;
  }
  SOFTSCOPE_HD void sumColumns(int thread, int offset, Shared& shared) const {
    for (int i = thread; i < kLeft; i += kThreads) {
      const std::uint32_t a = shared.left[0][i], b = shared.left[1][i], c = shared.left[2][i];
      for (int pair = 0; pair < kAtATime / 2; ++pair) {
        std::uint32_t both = 0;
        for (int k = 0; k < 2; ++k) {
          const int j = i + kDisparities - 1 - (offset + 2 * pair + k);
          const std::uint32_t sum = byteDifferences(
              a, shared.right[0][j],
              byteDifferences(b, shared.right[1][j], byteDifferences(c, shared.right[2][j], 0)));
          both |= sum << (16 * k);
        }
        shared.sums[pair][i] = both;
      }
    }
  }
  SOFTSCOPE_HD void addCosts(int thread, int r, int u0, int first, int last, int offset,
                             Shared& shared, Local& local) const {
    const int u = u0 + thread;
    for (int pair = 0; pair < kAtATime / 2; ++pair) {
      const std::uint32_t* sums = shared.sums[pair] + thread;
      const std::uint32_t both = sums[0] + sums[2] + sums[4] + sums[6] + sums[8];
      for (int k = 0; k < 2; ++k) {
        const int index = offset + 2 * pair + k, d = first + index;
        // The whole window is inside both images.
        if (d > last || u >= grid.width || u < d + kMargin ||
            d + kMargin + kSupportNarrowest > grid.width)
          continue;
        const std::uint32_t cost = both >> (16 * k) & 0xFFFFu;
        const std::uint32_t key = cost << 16 | static_cast<std::uint32_t>(d);
        local.best = key < local.best ? key : local.best;
        atomicLeast(&shared.best_right[thread + kDisparities - 1 - index], key);
        if (u % grid.step == 0)
          out.volume[(static_cast<std::ptrdiff_t>(r) * grid.columns + u / grid.step) *
                         grid.count() +
                     d - grid.range.first] = static_cast<std::uint16_t>(cost);
      }
    }
  }
  SOFTSCOPE_HD void store(int thread, int r, int u0, int first, Shared& shared,
                          Local& local) const {
    const std::ptrdiff_t row = static_cast<std::ptrdiff_t>(r) * grid.width;
    if (local.best != kNoCost) atomicLeast(&out.best_left[row + u0 + thread], local.best);
    for (int i = thread; i < kThreads + kDisparities - 1; i += kThreads)
      if (shared.best_right[i] != kNoCost)
        atomicLeast(&out.best_right[row + u0 - (first + kDisparities - 1) + i],
                    shared.best_right[i]);
  }
};

/// Tests each pixel of the grid; kLanes threads per pixel search the second best cost.
struct SupportTestKernel {
  static constexpr int kThreads = 256, kPhases = 2, kLanes = 32, kPoints = kThreads / kLanes;
  struct Shared {
    int second[kPoints][kLanes], texture[kPoints][kLanes];
  };
  using Local = Nothing;
  SupportGrid grid;
  SupportPass pass;
  GradientPlane left;
  View<const std::uint8_t> ignored[2];
  SupportCosts costs;
  float* disparity_px;  // rows x columns

  Grid blocks() const { return {blocksFor(grid.columns, kPoints), pass.rowCount(grid.rows), 1}; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int point = at.thread / kLanes, lane = at.thread % kLanes;
    const int r = pass.rowOf(at.y), c = at.x * kPoints + point;
    if (!grid.hasRow(r) || c >= grid.columns) return;
    const int u = c * grid.step;
    const DisparityRange range = pass.range(grid);
    const std::uint32_t key = costs.best_left[static_cast<std::ptrdiff_t>(r) * grid.width + u];
    const std::uint16_t* volume =
        costs.volume + (static_cast<std::ptrdiff_t>(r) * grid.columns + c) * grid.count() -
        grid.range.first;
    const int disparity = static_cast<int>(key & 0xFFFFu);
    const int count = supportCountAt(u, grid.width, range.first, range.last - range.first + 1);
    if constexpr (kPhase == 0) {
      int second = 0xFFFF;
      for (int d = range.first + lane; d < range.first + count; d += kLanes) {
        const int apart = d - disparity;
        if (apart >= -1 && apart <= 1) continue;
        second = volume[d] < second ? volume[d] : second;
      }
      shared.second[point][lane] = second;
      shared.texture[point][lane] = textureOf(u, r * grid.step, lane);
    } else if (lane == 0) {
      int second = 0xFFFF, texture = 0;
      for (int k = 0; k < kLanes; ++k) {
        second = shared.second[point][k] < second ? shared.second[point][k] : second;
        texture += shared.texture[point][k];
      }
      disparity_px[r * grid.columns + c] =
          tested(u, r, key, disparity, second, texture, range, count, volume);
    }
  }

 private:
  static_assert(kLanes >= kSupportPixels, "a lane a pixel");
  /// Contribution of one pixel to the texture of the window.
  SOFTSCOPE_HD int textureOf(int u, int v, int lane) const {
    if (lane >= kSupportPixels || u < kSupportMargin || u >= grid.width - kSupportMargin) return 0;
    return supportTexture(
        *left.at(u + supportOffset(lane % kSupportSide), v + supportOffset(lane / kSupportSide)));
  }
  SOFTSCOPE_HD bool isBlocked(int view, int u, int v) const {
    return ignored[view].contains(u, v) && (ignored[view].at(u, v) & Ignored::kSupport) != 0;
  }
  SOFTSCOPE_HD float tested(int u, int r, std::uint32_t key, int disparity, int second, int texture,
                            const DisparityRange& range, int count,
                            const std::uint16_t* volume) const {
    const int cost = static_cast<int>(key >> 16);
    if (u < kSupportMargin || u >= grid.width - kSupportMargin || cost == 0xFFFF) return kNoSupport;
    if (static_cast<double>(texture) / kCostDifferences < grid.texture) return kNoSupport;
    if (isBlocked(0, u, r * grid.step) || isBlocked(1, u - disparity, r * grid.step))
      return kNoSupport;
    const int returned = static_cast<int>(
        costs.best_right[static_cast<std::ptrdiff_t>(r) * grid.width + u - disparity] & 0xFFFFu);
    const int apart = returned - disparity;
    if ((apart < 0 ? -apart : apart) > grid.left_right_px) return kNoSupport;
    // The true disparity may be outside of the range.
    if (disparity == range.first || disparity == range.last) return kNoSupport;
    if (cost > grid.uniqueness * second) return kNoSupport;
    if (disparity + 1 == range.first + count) return static_cast<float>(disparity);
    return static_cast<float>(disparity) +
           parabolaOffset(volume[disparity - 1], volume[disparity], volume[disparity + 1]);
  }
};

/// Range of the points of the first pass, with a margin: narrowedTo().
struct NarrowRangeKernel {
  static constexpr int kThreads = 1024, kPhases = 4;
  static constexpr int kNear = kNearDisparityPx;
  static constexpr int kBins = StereoOptions::kLargestDisparityPx + 1 + 2 * kNear;
  struct Shared {
    int alike[kBins];
    int found, low, high;
  };
  using Local = Nothing;
  SupportGrid grid;
  const float* disparity_px;
  DisparityRange* narrowed;

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int bins = grid.count() + 2 * kNear;
    if constexpr (kPhase == 0) {
      for (int i = at.thread; i < bins; i += kThreads) shared.alike[i] = 0;
      if (at.thread == 0) {
        shared.found = 0;
        shared.low = bins;
        shared.high = -1;
      }
    } else if constexpr (kPhase == 1) {
      const int rows = (grid.rows + 2) / 4;
      for (int i = at.thread; i < rows * grid.columns; i += kThreads)
        count(disparity_px[(4 * (i / grid.columns) + 1) * grid.columns + i % grid.columns], shared);
    } else if constexpr (kPhase == 2) {
      for (int i = at.thread; i < bins; i += kThreads)
        if (shared.alike[i] >= kFewestNear) {
          atomicLeast(&shared.low, i);
          atomicGreatest(&shared.high, i);
        }
    } else if (at.thread == 0) {
      *narrowed = grid.range;
      if (shared.found < kFewestForRange || shared.high < 0) return;
      const int lowest = grid.range.first - kNear + shared.low - kBeyondRangePx;
      const int highest = grid.range.first - kNear + shared.high + kBeyondRangePx;
      narrowed->first = lowest > grid.range.first ? lowest : grid.range.first;
      narrowed->last = highest < grid.range.last ? highest : grid.range.last;
    }
  }

 private:
  SOFTSCOPE_HD void count(float disparity, Shared& shared) const {
    if (disparity == kNoSupport) return;
    atomicPlus(&shared.found, 1);
    const int rounded = static_cast<int>(std::floor(disparity + 0.5f));
    const int in_range = rounded < grid.range.first
                             ? grid.range.first
                             : (rounded > grid.range.last ? grid.range.last : rounded);
    for (int k = 0; k <= 2 * kNear; ++k)
      atomicPlus(&shared.alike[in_range - grid.range.first + k], 1);
  }
};

/// Removes points confirmed by too few neighbours; counts the others. kLanes threads per point.
struct LonelyKernel {
  static constexpr int kThreads = 256, kPhases = 3, kLanes = 8, kPoints = kThreads / kLanes;
  struct Shared {
    int neighbours[kPoints][kLanes], count;
  };
  using Local = Nothing;
  SupportGrid grid;
  const float* disparity_px;
  float* kept;
  int* point_count;

  Grid blocks() const { return {blocksFor(grid.columns * grid.rows, kPoints), 1, 1}; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    const int point = at.thread / kLanes, lane = at.thread % kLanes;
    const int place = at.x * kPoints + point;
    const bool inside = place < grid.columns * grid.rows;
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared.count = 0;
      shared.neighbours[point][lane] = inside ? countRows(place, lane) : 0;
    } else if constexpr (kPhase == 1) {
      if (lane != 0 || !inside) return;
      int neighbours = -1;  // not itself
      for (int k = 0; k < kLanes; ++k) neighbours += shared.neighbours[point][k];
      const float here = disparity_px[place];
      const bool keep = here != kNoSupport && neighbours >= grid.min_neighbours;
      kept[place] = keep ? here : kNoSupport;
      if (keep) atomicPlus(&shared.count, 1);
    } else {
      if (at.thread == 0 && shared.count > 0) atomicPlus(point_count, shared.count);
    }
  }

 private:
  /// Neighbours that agree, in every kLanes-th row of the window.
  SOFTSCOPE_HD int countRows(int place, int lane) const {
    const float here = disparity_px[place];
    if (here == kNoSupport) return 0;
    const int c = place % grid.columns, r = place / grid.columns, reach = grid.window_cells;
    int count = 0;
    for (int y = r - reach + lane; y <= r + reach; y += kLanes)
      for (int x = c - reach; x <= c + reach; ++x) {
        if (x < 0 || y < 0 || x >= grid.columns || y >= grid.rows) continue;
        const float there = disparity_px[y * grid.columns + x];
        const float apart = there < here ? here - there : there - here;
        count += there != kNoSupport && apart <= static_cast<float>(grid.agreement_px);
      }
    return count;
  }
};

}  // namespace softscope::cuda
