// src/stereo/matching_kernels.cpp: plain loops of fixed length that the compiler turns into SIMD;
// SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/matching_kernels.h"

#define SOFTSCOPE_NAME_(name, set) name##_##set
#define SOFTSCOPE_NAME(name, set) SOFTSCOPE_NAME_(name, set)

namespace softscope {
namespace {

inline int clampByte(int x) { return x < 0 ? 0 : (x > 255 ? 255 : x); }

inline std::uint8_t absDifference(std::uint8_t a, std::uint8_t b) {
  return static_cast<std::uint8_t>(a > b ? a - b : b - a);
}

void sobelRow(const std::uint8_t* above, const std::uint8_t* middle, const std::uint8_t* below,
              int width, int gain_q8, std::uint8_t* du, std::uint8_t* dv) {
  for (int u = 0; u < width; ++u) {
    const int right = above[u + 1] + 2 * middle[u + 1] + below[u + 1];
    const int left = above[u - 1] + 2 * middle[u - 1] + below[u - 1];
    const int bottom = below[u - 1] + 2 * below[u] + below[u + 1];
    const int top = above[u - 1] + 2 * above[u] + above[u + 1];
    du[u] = static_cast<std::uint8_t>(clampByte(128 + ((right - left) * gain_q8 + 128) / 256));
    dv[u] = static_cast<std::uint8_t>(clampByte(128 + ((bottom - top) * gain_q8 + 128) / 256));
  }
}

// --- support points: 9 x 9 window, every second pixel: 2 x 5 x 5 differences -------------------

void supportColumnSums(const GradientView& left, const GradientView& right, int v, int width, int d,
                       std::uint16_t* sums) {
  for (int u = -kSupportMargin; u < width + kSupportMargin; ++u) sums[u] = 0;
  for (int dy = -kSupportMargin; dy <= kSupportMargin; dy += 2) {
    const std::uint8_t* left_du = left.du + (v + dy) * left.stride;
    const std::uint8_t* left_dv = left.dv + (v + dy) * left.stride;
    const std::uint8_t* right_du = right.du + (v + dy) * right.stride - d;
    const std::uint8_t* right_dv = right.dv + (v + dy) * right.stride - d;
    for (int u = -kSupportMargin; u < width + kSupportMargin; ++u)
      sums[u] = static_cast<std::uint16_t>(sums[u] + absDifference(left_du[u], right_du[u]) +
                                           absDifference(left_dv[u], right_dv[u]));
  }
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
    supportColumnSums(left, right, v, width, d, sums);
    std::uint16_t* cost = out.volume + static_cast<long>(i) * out.stride;
    for (int u = 0; u < width; ++u)
      cost[u] = static_cast<std::uint16_t>(sums[u - 4] + sums[u - 2] + sums[u] + sums[u + 2] +
                                           sums[u + 4]);
    const int first = d + kSupportMargin;  // the whole window lies inside both pictures
    const std::uint16_t disparity = static_cast<std::uint16_t>(d);
    for (int u = 0; u < first && u < width; ++u) cost[u] = 0xFFFF;
    for (int u = 0; u < width; ++u) {
      const bool better = cost[u] < out.cost_left[u];
      out.cost_left[u] = better ? cost[u] : out.cost_left[u];
      out.disparity_left[u] = better ? disparity : out.disparity_left[u];
    }
    for (int u = 0; u < width - d; ++u) {
      const bool better = cost[u + d] < out.cost_right[u];
      out.cost_right[u] = better ? cost[u + d] : out.cost_right[u];
      out.disparity_right[u] = better ? disparity : out.disparity_right[u];
    }
  }
}

// --- dense matching: 5 x 5 window: 2 x 25 differences ------------------------------------------

constexpr int kReach = 2;
constexpr int kRows = kTileHeight + 2 * kReach;
constexpr int kColumns = kTileWidth + 2 * kReach;

/// sums[y][x] = differences of the five columns x-2..x+2 in row y - 2 of the tile.
void tileRowSums(const GradientView& reference, const GradientView& other, const DenseTile& tile,
                 int d, std::uint16_t (*sums)[kTileWidth]) {
  const int shift = tile.direction * d - kReach;
  for (int y = 0; y < kRows; ++y) {
    const long row = tile.v0 + y - kReach;
    const std::uint8_t* a_du = reference.du + row * reference.stride + tile.u0 - kReach;
    const std::uint8_t* a_dv = reference.dv + row * reference.stride + tile.u0 - kReach;
    const std::uint8_t* b_du = other.du + row * other.stride + tile.u0 + shift;
    const std::uint8_t* b_dv = other.dv + row * other.stride + tile.u0 + shift;
    std::uint16_t difference[kColumns];
    for (int x = 0; x < kColumns; ++x)
      difference[x] = static_cast<std::uint16_t>(absDifference(a_du[x], b_du[x]) +
                                                 absDifference(a_dv[x], b_dv[x]));
    for (int x = 0; x < kTileWidth; ++x)
      sums[y][x] =
          static_cast<std::uint16_t>(difference[x] + difference[x + 1] + difference[x + 2] +
                                     difference[x + 3] + difference[x + 4]);
  }
}

/// Adds the prior and keeps the better disparity; one row of the tile.
inline void updateRow(const DenseTile& tile, int y, int d, bool everywhere, int first, int last,
                      const std::uint16_t* cost) {
  const std::int16_t* prior = tile.prior_px8 + y * kTileWidth;
  std::uint16_t* best_cost = tile.best_cost + y * kTileWidth;
  std::uint16_t* best_disparity = tile.best_disparity + y * kTileWidth;
  const std::int16_t d8 = static_cast<std::int16_t>(d * 8);
  const std::int16_t band = static_cast<std::int16_t>(everywhere ? 0x7FFF : tile.band_px8);
  const std::uint16_t slope = static_cast<std::uint16_t>(tile.prior_slope);
  const std::uint16_t cap = static_cast<std::uint16_t>(tile.prior_cap);
  for (int x = 0; x < kTileWidth; ++x) {
    const std::int16_t away = static_cast<std::int16_t>(d8 - prior[x]);
    const std::int16_t t = away < 0 ? static_cast<std::int16_t>(-away) : away;
    const int t4 = t > 31 ? 15 : t >> 1;  // quarter pixels, so that slope t4² fits 16 bits
    const std::uint16_t raw =
        static_cast<std::uint16_t>(static_cast<std::uint16_t>(t4 * t4 * slope) >> 4);
    const std::uint16_t prior_cost = raw < cap ? raw : cap;
    const std::uint16_t total = static_cast<std::uint16_t>(cost[x] + prior_cost);
    const bool allowed = t <= band && x >= first && x <= last;
    const bool better = allowed && total < best_cost[x];
    best_cost[x] = better ? total : best_cost[x];
    best_disparity[x] = better ? static_cast<std::uint16_t>(d) : best_disparity[x];
  }
}

void denseTile(const GradientView& reference, const GradientView& other, const DenseTile& tile) {
  for (int i = 0; i < kTileWidth * kTileHeight; ++i) {
    tile.best_cost[i] = 0xFFFF;
    tile.best_disparity[i] = 0;
  }
  std::uint16_t sums[kRows][kTileWidth];
  for (int i = 0; i < tile.candidate_count; ++i) {
    const int d = tile.disparities[i];
    // The other pixel's window lies inside its picture.
    const int first = tile.direction < 0 ? d + kReach - tile.u0 : 0;
    const int last = tile.direction < 0 ? kTileWidth : tile.width_px - 1 - kReach - d - tile.u0;
    if (first >= kTileWidth || last < 0) continue;
    tileRowSums(reference, other, tile, d, sums);
    std::uint16_t cost[kTileWidth];
    for (int x = 0; x < kTileWidth; ++x)
      cost[x] = static_cast<std::uint16_t>(sums[0][x] + sums[1][x] + sums[2][x] + sums[3][x]);
    for (int y = 0; y < kTileHeight; ++y) {
      for (int x = 0; x < kTileWidth; ++x)
        cost[x] = static_cast<std::uint16_t>(cost[x] + sums[y + 4][x]);
      updateRow(tile, y, d, tile.everywhere[i] != 0, first, last, cost);
      for (int x = 0; x < kTileWidth; ++x)
        cost[x] = static_cast<std::uint16_t>(cost[x] - sums[y][x]);
    }
  }
}

}  // namespace

extern const MatchingKernels SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET);
const MatchingKernels SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET) = {sobelRow, supportRow,
                                                                             denseTile};

}  // namespace softscope
