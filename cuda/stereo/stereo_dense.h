// cuda/stereo/stereo_dense.h: kernel bodies of dense matching, integer disparities of both views.
#pragma once

#include <cmath>

#include "cuda/device/kernel.h"
#include "cuda/stereo/stereo_support.h"
#include "stereo/kernels/matching_formulas.h"

namespace softscope::cuda {

/// Column in the right view of a support point of the left one.
SOFTSCOPE_HD inline int columnFromRight(int u, float disparity_px) {
  return u - static_cast<int>(disparity_px + 0.5f);
}

/// Disparities of the support points in each tile, one bit each, for both views.
struct TileBits {
  static constexpr int kWords = (StereoOptions::kLargestDisparityPx + 1) / 32;
  std::uint32_t* words;  // 2 x tiles x kWords
  int columns, rows;

  SOFTSCOPE_HD std::uint32_t* tile(int view, int c, int r) const {
    return words + ((static_cast<std::ptrdiff_t>(view) * rows + r) * columns + c) * kWords;
  }
};
struct TileBitsBody {
  SupportGrid grid;
  const float* disparity_px;
  TileBits bits;

  SOFTSCOPE_HD void operator()(int c, int r, int view) const {
    const float d = disparity_px[r * grid.columns + c];
    if (d == kNoSupport) return;
    const int u = view == 0 ? c * grid.step : columnFromRight(c * grid.step, d);
    if (u < 0) return;
    const int bit = static_cast<int>(std::floor(d + 0.5f));
    atomicUnite(bits.tile(view, u / kTileWidth, r * grid.step / kTileHeight) + bit / 32,
                std::uint32_t{1} << (bit % 32));
  }
};

/// Best disparity of each pixel of a tile under its prior; blocks in z are the two views.
/// Two groups of threads share the candidates, one thread has two columns and four rows.
struct DenseKernel {
  static constexpr int kThreads = 128, kPhases = 7, kGroup = 64, kRowsOfThread = 4;
  static constexpr int kWindowRows = kRowsOfThread + 4;
  struct Shared {
    int low, high, count;
    std::uint32_t shared[TileBits::kWords], candidates[TileBits::kWords];
    std::uint16_t list[32 * TileBits::kWords];  // disparity, kEverywhere where shared
    std::uint32_t best[2 * kRowsOfThread][kGroup];
  };
  struct Local {
    std::uint32_t best[2 * kRowsOfThread];
  };
  static constexpr int kEverywhere = 0x8000;
  GradientPlane image[2];
  View<const std::int16_t> prior[2];  // 1/8 px
  View<const std::uint8_t> ignored[2];
  View<std::int16_t> disparity[2];  // -1: none
  TileBits bits;
  const int* point_count;
  PriorCost cost;
  DisparityRange range;

  Grid blocks() const { return {bits.columns, bits.rows, 2}; }

  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local& local) const {
    const View<const std::int16_t> priors = prior[at.z];
    const int thread = at.thread, u0 = at.x * kTileWidth, v0 = at.y * kTileHeight;
    if constexpr (kPhase == 0) {
      if (thread == 0) {
        shared.low = 32767;
        shared.high = -32768;
        shared.count = 0;
      }
      if (thread < TileBits::kWords) shared.shared[thread] = wordAround(at, thread);
    } else if constexpr (kPhase == 1) {
      for (int i = thread; i < kTileWidth * kTileHeight; i += kThreads) {
        const int u = u0 + i % kTileWidth, v = v0 + i / kTileWidth;
        if (!priors.contains(u, v)) continue;
        const int value = priors.at(u, v);
        if (value < shared.low) atomicLeast(&shared.low, value);
        if (value > shared.high) atomicGreatest(&shared.high, value);
      }
    } else if constexpr (kPhase == 2) {
      if (thread < TileBits::kWords) shared.candidates[thread] = candidatesOf(thread, shared);
    } else if constexpr (kPhase == 3) {
      if (thread<TileBits::kWords&& * point_count> 0) listWord(thread, shared);
    } else if constexpr (kPhase == 4) {
      match(at, shared, local);
    } else if constexpr (kPhase == 5) {
      if (thread >= kGroup)
        for (int i = 0; i < 2 * kRowsOfThread; ++i) shared.best[i][thread - kGroup] = local.best[i];
    } else if (thread < kGroup) {
      store(at, shared, local);
    }
  }

 private:
  SOFTSCOPE_HD std::uint32_t wordAround(const Place& at, int word) const {
    std::uint32_t all = 0;
    for (int y = at.y - 1; y <= at.y + 1; ++y)
      for (int x = at.x - 1; x <= at.x + 1; ++x)
        if (x >= 0 && y >= 0 && x < bits.columns && y < bits.rows)
          all |= bits.tile(at.z, x, y)[word];
    return all;
  }
  SOFTSCOPE_HD static std::uint32_t widened(const Shared& shared, int word) {
    const std::uint32_t here = shared.shared[word];
    const std::uint32_t before = word > 0 ? shared.shared[word - 1] : 0,
                        after = word + 1 < TileBits::kWords ? shared.shared[word + 1] : 0;
    return here | here << 1 | before >> 31 | here >> 1 | after << 31;
  }
  /// Bits first .. last of a word.
  SOFTSCOPE_HD static std::uint32_t between(int first, int last, int word) {
    const int low = first - 32 * word, high = last - 32 * word;
    if (high < 0 || low > 31 || low > high) return 0;
    const std::uint32_t from = low <= 0 ? ~0u : ~0u << low;
    return from & (high >= 31 ? ~0u : (2u << high) - 1);
  }
  SOFTSCOPE_HD std::uint32_t candidatesOf(int word, const Shared& shared) const {
    const DisparityBand band =
        bandAround(shared.low, shared.high, cost.band_px8, range.first, range.last);
    return (widened(shared, word) & between(range.first, range.last, word)) |
           between(band.first, band.last, word);
  }
  SOFTSCOPE_HD static void listWord(int word, Shared& shared) {
    int place = 0;
    for (int k = 0; k < word; ++k) place += countBits(shared.candidates[k]);
    const std::uint32_t candidates = shared.candidates[word], everywhere = widened(shared, word);
    for (int bit = 0; bit < 32; ++bit)
      if ((candidates >> bit & 1) != 0)
        shared.list[place++] = static_cast<std::uint16_t>(
            (32 * word + bit) | ((everywhere >> bit & 1) != 0 ? kEverywhere : 0));
    if (word + 1 == TileBits::kWords) shared.count = place;
  }

  /// Words of a row of the window around two columns: the pixels 0 and 1, 2 and 3, 4 and 5.
  struct RowWords {
    std::uint32_t a, b, c;
  };
  /// Aligned: `first` is even.
  SOFTSCOPE_HD static RowWords wordsAt(const std::uint16_t* first) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(first);
    return {words[0], words[1], words[2]};
  }
  SOFTSCOPE_HD static RowWords oddWordsAt(const std::uint16_t* first) {
    const auto* words = reinterpret_cast<const std::uint32_t*>(first - 1);
    const std::uint32_t a = words[0], b = words[1], c = words[2], d = words[3];
    return {a >> 16 | b << 16, b >> 16 | c << 16, c >> 16 | d << 16};
  }

  SOFTSCOPE_HD void match(const Place& at, const Shared& shared, Local& local) const {
    const int lane = at.thread % kGroup, group = at.thread / kGroup;
    const int u = at.x * kTileWidth + lane % 16 * 2;
    const int v = at.y * kTileHeight + lane / 16 * kRowsOfThread;
    const View<const std::int16_t> priors = prior[at.z];
    const GradientPlane &own = image[at.z], &other = image[1 - at.z];
    for (int i = 0; i < 2 * kRowsOfThread; ++i) local.best[i] = kNoCost;
    if (u >= priors.width || v >= priors.height) return;
    const int rows = priors.height - v < kRowsOfThread ? priors.height - v : kRowsOfThread;
    const int columns = priors.width - u < 2 ? 1 : 2;
    RowWords words[kWindowRows];
    std::int16_t prior_px8[2 * kRowsOfThread];
    for (int y = 0; y < kWindowRows; ++y)
      words[y] = wordsAt(own.at(u - 2, v - 2 + (y < rows + 4 ? y : rows + 3)));
    for (int i = 0; i < 2 * kRowsOfThread; ++i)
      prior_px8[i] = priors.at(u + (columns == 2 ? i % 2 : 0), v + (i / 2 < rows ? i / 2 : 0));
    for (int i = group; i < shared.count; i += kThreads / kGroup) {
      const int entry = shared.list[i], d = entry & (kEverywhere - 1);
      const int band = (entry & kEverywhere) != 0 ? 0x7FFF : cost.band_px8;
      const int from = u - 2 + (at.z == 0 ? -d : d);
      int sums[2][kWindowRows];
      for (int y = 0; y < kWindowRows; ++y) {
        const std::uint16_t* start = other.at(from, v - 2 + (y < rows + 4 ? y : rows + 3));
        rowSums(words[y], (d & 1) != 0 ? oddWordsAt(start) : wordsAt(start), sums[0][y],
                sums[1][y]);
      }
      for (int x = 0; x < 2; ++x) {
        // The window of the other pixel is inside its image.
        if (at.z == 0 ? u + x < d + 2 : u + x + d + 2 > priors.width - 1) continue;
        int sum = sums[x][0] + sums[x][1] + sums[x][2] + sums[x][3];
        for (int y = 0; y < kRowsOfThread; ++y) {
          sum += sums[x][y + 4];
          const int distance = priorDistancePx8(d, prior_px8[2 * y + x]);
          const std::uint32_t key = static_cast<std::uint32_t>(sum + costOfDistance(cost, distance))
                                        << 16 |
                                    static_cast<std::uint32_t>(d);
          if (distance <= band && key < local.best[2 * y + x]) local.best[2 * y + x] = key;
          sum -= sums[x][y];
        }
      }
    }
  }
  /// Differences of five pixels for each of two columns.
  SOFTSCOPE_HD static void rowSums(const RowWords& own, const RowWords& other, int& first,
                                   int& second) {
    constexpr std::uint32_t kLow = 0xFFFFu, kHigh = 0xFFFF0000u;
    const std::uint32_t both = byteDifferences(own.b, other.b, 0);
    first = static_cast<int>(
        byteDifferences(own.a, other.a, byteDifferences(own.c & kLow, other.c & kLow, both)));
    second = static_cast<int>(
        byteDifferences(own.c, other.c, byteDifferences(own.a & kHigh, other.a & kHigh, both)));
  }
  SOFTSCOPE_HD void store(const Place& at, const Shared& shared, const Local& local) const {
    const int u = at.x * kTileWidth + at.thread % 16 * 2;
    const int v = at.y * kTileHeight + at.thread / 16 * kRowsOfThread;
    for (int i = 0; i < 2 * kRowsOfThread; ++i) {
      if (!disparity[at.z].contains(u + i % 2, v + i / 2)) continue;
      const std::uint32_t other = shared.best[i][at.thread];
      const std::uint32_t best = local.best[i] < other ? local.best[i] : other;
      const bool none =
          best >> 16 == 0xFFFFu || (ignored[at.z].at(u + i % 2, v + i / 2) & Ignored::kDense) != 0;
      disparity[at.z].at(u + i % 2, v + i / 2) =
          static_cast<std::int16_t>(none ? -1 : static_cast<int>(best & 0xFFFFu));
    }
  }
};

}  // namespace softscope::cuda
