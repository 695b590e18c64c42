// src/stereo/kernels/matching_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/matching_kernels.h"

#include "core/kernel_list.h"
#include "stereo/kernels/matching_formulas.h"
#include "stereo/kernels/simd.h"

namespace softscope {
namespace {

void sobelRow(const std::uint8_t* above, const std::uint8_t* middle, const std::uint8_t* below,
              int width, int gain_q8, std::uint16_t* packed) {
  for (int u = 0; u < width; ++u)
    packed[u] = packedGradient(above, middle, below, u - 1, u, u + 1, gain_q8);
}

/// |a - b| of both gradients, added; kWordLanes pixels.
inline Words gradientDifference(const std::uint16_t* a, const std::uint16_t* b) {
  const auto x = load<Bytes>(a), y = load<Bytes>(b);
  const Bytes apart = greatest(x, y) - least(x, y);
#ifdef __AVX2__
  // Products with 1, added in pairs, by one instruction.
  using SignedBytes = char __attribute__((vector_size(32)));
  return reinterpret_cast<Words>(__builtin_ia32_pmaddubsw256(reinterpret_cast<SignedBytes>(apart),
                                                             SignedBytes{} + static_cast<char>(1)));
#else
  const Words pairs = reinterpret_cast<Words>(apart);
  return (pairs & std::uint16_t{0xFF}) + (pairs >> 8);
#endif
}

// --- support points: 9 x 9 window, every second pixel: 2 x 5 x 5 differences -------------------

/// Differences of the window's five rows at disparity d, for the columns from `first` on.
void supportColumnSums(const GradientView& left, const GradientView& right, int v, int first,
                       int width, int d, std::uint16_t* sums) {
  for (int u = first - kSupportMargin; u < width + kSupportMargin; u += kWordLanes) {
    Words sum{};
    for (int dy = -kSupportMargin; dy <= kSupportMargin; dy += 2)
      sum += gradientDifference(left.at(u, v + dy), right.at(u - d, v + dy));
    store(sums + u, sum);
  }
}

/// Keeps the better one per column.
inline void keepBetter(Words cost, std::uint16_t disparity, std::uint16_t* best_cost,
                       std::uint16_t* best_disparity) {
  const Words before = load<Words>(best_cost);
  store(best_disparity, cost < before ? Words{} + disparity : load<Words>(best_disparity));
  store(best_cost, least(cost, before));
}

/// One disparity, kWordLanes columns.
inline void supportCosts(const SupportRow& out, const std::uint16_t* sums, int u, int d,
                         std::uint16_t* cost) {
  Words sum{};
  for (int x = -kSupportMargin; x <= kSupportMargin; x += 2) sum += load<Words>(sums + u + x);
  store(cost + u, sum);
  const auto disparity = static_cast<std::uint16_t>(d);
  keepBetter(sum, disparity, out.cost_left + u, out.disparity_left + u);
  keepBetter(sum, disparity, out.cost_right + u - d, out.disparity_right + u - d);
}

void supportRow(const GradientView& left, const GradientView& right, int v, int width,
                int disparity_min, int disparity_count, const SupportRow& out) {
  for (int u = 0; u < width; ++u) {
    out.cost_left[u] = out.cost_right[u] = 0xFFFF;
    out.disparity_left[u] = out.disparity_right[u] = 0;
  }
  std::uint16_t* sums = out.sums + kSupportMargin;
  for (int i = 0; i < disparity_count; ++i) {
    const int d = disparity_min + i;
    const int first = d + kSupportMargin;  // the whole window is inside both images
    if (first + kSupportNarrowest > width) break;
    supportColumnSums(left, right, v, first, width, d, sums);
    std::uint16_t* cost = out.volume + static_cast<long>(i) * out.stride;
    int u = first;
    for (; u + kWordLanes <= width; u += kWordLanes) supportCosts(out, sums, u, d, cost);
    // The last columns, some of them again with the same result.
    if (u < width) supportCosts(out, sums, width - kWordLanes, d, cost);
  }
}

// --- dense matching: 5 x 5 window: 2 x 25 differences ------------------------------------------

constexpr int kReach = 2;
constexpr int kRows = kTileHeight + 2 * kReach;
constexpr int kColumns = kTileWidth + kWordLanes;  // the window's reach needs 4 more: a register

using TileRow = std::uint16_t[kTileWidth];

/// sums[y][x] = differences of the five columns x - 2 .. x + 2 in row y - 2 of the tile.
void tileRowSums(const GradientView& reference, const GradientView& other, const DenseTile& tile,
                 int d, TileRow* sums) {
  const int u = tile.u0 - kReach, shift = tile.direction * d;
  alignas(64) std::uint16_t difference[kRows][kColumns];
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kColumns; x += kWordLanes)
      store(difference[y] + x, gradientDifference(reference.at(u + x, tile.v0 + y - kReach),
                                                  other.at(u + x + shift, tile.v0 + y - kReach)));
  for (int y = 0; y < kRows; ++y)
    for (int x = 0; x < kTileWidth; x += kWordLanes) {
      Words sum = load<Words>(difference[y] + x);
      for (int k = 1; k <= 2 * kReach; ++k) sum += load<Words>(difference[y] + x + k);
      store(sums[y] + x, sum);
    }
}

/// Adds the prior to the cost and keeps the better disparity; kWordLanes columns
/// of one row. `forbidden`: 0xFFFF for disparities outside of the image.
inline void tryDisparity(const DenseTile& tile, int at, int d, std::int16_t band, Words forbidden,
                         Words cost) {
  const SignedWords zero{};
  const SignedWords away =
      static_cast<std::int16_t>(d * 8) - load<SignedWords>(tile.prior_px8 + at);
  const SignedWords t = greatest(away, zero - away);
  // Quarter pixels, so that slope t4² fits 16 bits.
  const Words t4 = reinterpret_cast<Words>(least(t, zero + std::int16_t{31})) >> 1;
  const Words prior = least((t4 * t4 * static_cast<std::uint16_t>(tile.prior_slope)) >> 4,
                            Words{} + static_cast<std::uint16_t>(tile.prior_cap));
  const Words outside = reinterpret_cast<Words>(t > zero + band);
  keepBetter((cost + prior) | outside | forbidden, static_cast<std::uint16_t>(d),
             tile.best_cost + at, tile.best_disparity + at);
}

/// 0xFFFF in the columns before `first` and after `last`.
inline void forbid(int first, int last, std::uint16_t* forbidden) {
  for (int x = 0; x < kTileWidth; ++x) forbidden[x] = x >= first && x <= last ? 0 : 0xFFFF;
}

void denseTile(const GradientView& reference, const GradientView& other, const DenseTile& tile) {
  for (int i = 0; i < kTileWidth * kTileHeight; ++i) {
    tile.best_cost[i] = 0xFFFF;
    tile.best_disparity[i] = 0;
  }
  alignas(64) TileRow sums[kRows];
  alignas(64) TileRow forbidden;
  for (int i = 0; i < tile.candidate_count; ++i) {
    const int d = tile.disparities[i];
    // The window of the other pixel is inside its image.
    const int first = tile.direction < 0 ? d + kReach - tile.u0 : 0;
    const int last = tile.direction < 0 ? kTileWidth : tile.width_px - 1 - kReach - d - tile.u0;
    if (first >= kTileWidth || last < 0) continue;
    forbid(first, last, forbidden);
    tileRowSums(reference, other, tile, d, sums);
    const std::int16_t band =
        static_cast<std::int16_t>(tile.everywhere[i] != 0 ? 0x7FFF : tile.band_px8);
    for (int x = 0; x < kTileWidth; x += kWordLanes) {
      Words cost{};
      for (int y = 0; y < 2 * kReach; ++y) cost += load<Words>(sums[y] + x);
      for (int y = 0; y < kTileHeight; ++y) {
        cost += load<Words>(sums[y + 2 * kReach] + x);
        tryDisparity(tile, y * kTileWidth + x, d, band, load<Words>(forbidden + x), cost);
        cost -= load<Words>(sums[y] + x);
      }
    }
  }
}

}  // namespace

extern const MatchingKernels SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET);
const MatchingKernels SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET) = {sobelRow, supportRow,
                                                                             denseTile};

}  // namespace softscope
