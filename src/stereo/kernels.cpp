// src/stereo/kernels.cpp: plain loops of fixed length that the compiler turns into SIMD;
// compiled once a set, with SOFTSCOPE_SIMD_SET naming it.
#include "stereo/kernels.h"

#include <cstring>

#define SOFTSCOPE_NAME_(set) stereoKernels_##set
#define SOFTSCOPE_NAME(set) SOFTSCOPE_NAME_(set)
#define SOFTSCOPE_TEXT_(set) #set
#define SOFTSCOPE_TEXT(set) SOFTSCOPE_TEXT_(set)

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

// --- sub-pixel refinement ----------------------------------------------------------------------

using Float8 = float __attribute__((vector_size(32)));

// One unaligned instruction each.
inline Float8 load8(const float* p) {
  Float8 x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline void store8(float* p, Float8 x) { std::memcpy(p, &x, sizeof x); }

void residualRow(const ResidualRow& row) {
  const float last = static_cast<float>(row.width - 1);
  for (int u = 0; u < row.width; ++u) {
    float x = static_cast<float>(u) - row.disparity[u];
    const float inside = (x >= 0.0f && x <= last) ? row.valid[u] : 0.0f;
    x = x < 0.0f ? 0.0f : (x > last ? last : x);
    const int i = static_cast<int>(x);
    const float t = x - static_cast<float>(i);
    // Catmull-Rom through four pixels: value and slope.
    const float p0 = row.right[i - 1], p1 = row.right[i], p2 = row.right[i + 1],
                p3 = row.right[i + 2];
    const float c1 = 0.5f * (p2 - p0), c2 = p0 - 2.5f * p1 + 2.0f * p2 - 0.5f * p3,
                c3 = 1.5f * (p1 - p2) + 0.5f * (p3 - p0);
    const float value = p1 + t * (c1 + t * (c2 + t * c3));
    const float g = c1 + t * (2.0f * c2 + t * (3.0f * c3));
    const float r = value - row.left[u];
    const float w = inside / (1.0f + r * r * row.inverse_noise_sq);
    row.information[u] = w * (g * g + row.prior_weight);
    row.target[u] = w * (g * (g * row.disparity[u] + r) + row.prior_weight * row.disparity[u]);
    row.residual_sq[u] = w * r * r;
    row.weight[u] = w;
    row.difference_sq[u] = inside * r * r;
    row.energy[u] = inside * (value * value + row.left[u] * row.left[u]);
  }
}

void horizontalMoments(const float* in, const float* window, int radius, int width, float* out_0,
                       float* out_1, float* out_2) {
  for (int u = 0; u < width; u += 8) {
    Float8 s0{}, s1{}, s2{};
    for (int x = -radius; x <= radius; ++x) {
      const Float8 a = load8(in + u + x) * window[x + radius];
      const float fx = static_cast<float>(x);
      s0 += a;
      s1 += a * fx;
      s2 += a * (fx * fx);
    }
    store8(out_0 + u, s0);
    if (out_1 != nullptr) store8(out_1 + u, s1);
    if (out_2 != nullptr) store8(out_2 + u, s2);
  }
}

void verticalMoments(const float* const* g_0, const float* const* g_1, const float* const* g_2,
                     const float* const* q_0, const float* const* q_1, const float* window,
                     int radius, int width, const MomentRow& out) {
  for (int u = 0; u < width; u += 8) {
    Float8 a00{}, a10{}, a01{}, a20{}, a11{}, a02{}, b0{}, b1{}, b2{};
    for (int y = -radius; y <= radius; ++y) {
      const int k = y + radius;
      const float w = window[k], wy = w * static_cast<float>(y);
      const Float8 g0 = load8(g_0[k] + u), g1 = load8(g_1[k] + u), q0 = load8(q_0[k] + u);
      a00 += w * g0;
      a01 += wy * g0;
      a02 += wy * static_cast<float>(y) * g0;
      a10 += w * g1;
      a11 += wy * g1;
      a20 += w * load8(g_2[k] + u);
      b0 += w * q0;
      b2 += wy * q0;
      b1 += w * load8(q_1[k] + u);
    }
    const Float8 sums[] = {a00, a10, a01, a20, a11, a02, b0, b1, b2};
    for (int k = 0; k < 9; ++k) store8(out.sums[k] + u, sums[k]);
  }
}

void selectedMoments(const SelectedWindow& at, int u, const MomentRow& out) {
  const float centre = at.disparity[0];
  float sums[9][kSelectLanes] = {};
  for (int y = -at.radius; y <= at.radius; ++y) {
    const long row = static_cast<long>(y) * at.stride - at.radius;
    const int k = (y + at.radius) * kSelectLanes;
    const float fy = static_cast<float>(y);
    for (int i = 0; i < kSelectLanes; ++i) {
      const float away = at.disparity[row + i] - centre;
      const float apart = away < 0 ? -away : away;
      const float w = apart <= at.tolerance[k + i] ? at.window[k + i] : 0.0f;
      const float g = w * at.information[row + i], q = w * at.target[row + i];
      const float gy = fy * g;
      sums[0][i] += g;
      sums[1][i] += gy;
      sums[2][i] += fy * gy;
      sums[3][i] += q;
      sums[4][i] += fy * q;
      sums[5][i] += w * at.residual_sq[row + i];
      sums[6][i] += w * at.weight[row + i];
      sums[7][i] += w * at.difference_sq[row + i];
      sums[8][i] += w * at.energy[row + i];
    }
  }
  float moments[kMomentCount] = {};
  for (int i = 0; i < kSelectLanes; ++i) {
    const float x = static_cast<float>(i - at.radius);
    moments[0] += sums[0][i];
    moments[1] += x * sums[0][i];
    moments[2] += sums[1][i];
    moments[3] += x * x * sums[0][i];
    moments[4] += x * sums[1][i];
    moments[5] += sums[2][i];
    moments[6] += sums[3][i];
    moments[7] += x * sums[3][i];
    moments[8] += sums[4][i];
    moments[9] += sums[5][i];
    moments[10] += sums[6][i];
    moments[11] += sums[7][i];
    moments[12] += sums[8][i];
  }
  for (int m = 0; m < kMomentCount; ++m) out.sums[m][u] = moments[m];
}

/// D of the 3 x 3 system by Cramer's rule; NaN where the window makes no plane.
void solvePlanes(const PlaneRow& row) {
  const float nan = __builtin_nanf("");
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; ++u) {
    const float a = m[0][u], b = m[1][u], c = m[2][u], d = m[3][u], e = m[4][u], f = m[5][u];
    const float c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
    const float determinant = a * c00 + b * c01 + c * c02;
    const float found = (c00 * m[6][u] + c01 * m[7][u] + c02 * m[8][u]) / determinant;
    const float step = found - row.before[u];
    const float farthest = step < 0.0f ? -step : step;
    // Comparisons with NaN are false, so an unmatched pixel stays unmatched.
    const bool holds = determinant > 1e-3f * a * d * f && farthest < row.farthest_step_px;
    row.disparity[u] = holds ? row.before[u] + row.relaxation * step : nan;
  }
}

/// Standard errors of what solvePlanes() found; NaN, and the disparity too, where it can't be
/// trusted.
void judgePlanes(const PlaneRow& row) {
  const float nan = __builtin_nanf("");
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; ++u) {
    const float a = m[0][u], b = m[1][u], c = m[2][u], d = m[3][u], e = m[4][u], f = m[5][u];
    const float c00 = d * f - e * e;
    const float determinant = a * c00 + b * (c * e - b * f) + c * (b * e - c * d);
    // The matched disparity steadies the fit but is no evidence: it doesn't lower the error.
    const float raw = 1.0f - row.prior_weight * m[10][u] / a;
    const float evidence = raw > 1e-3f ? raw : 1e-3f;
    const float noise_sq = m[9][u] / m[10][u] + row.noise_floor_sq;
    const float variance =
        noise_sq * (c00 / determinant) / (evidence * evidence * row.independent_pixels) +
        row.model_variance_px2;
    const bool holds = row.disparity[u] == row.disparity[u] && variance <= row.max_variance_px2 &&
                       m[11][u] <= row.max_difference * m[12][u];
    row.disparity[u] = holds ? row.disparity[u] : nan;
    row.sigma[u] = holds ? __builtin_sqrtf(variance) : nan;
  }
}

void sumRows(const float* const* in, const float* weights, int taps, int width, float* out) {
  for (int u = 0; u < width; u += 8) {
    Float8 sum{};
    for (int t = 0; t < taps; ++t) sum += weights[t] * load8(in[t] + u);
    store8(out + u, sum);
  }
}

}  // namespace

extern const StereoKernels SOFTSCOPE_NAME(SOFTSCOPE_SIMD_SET);
const StereoKernels SOFTSCOPE_NAME(SOFTSCOPE_SIMD_SET) = {SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
                                                          sobelRow,
                                                          supportRow,
                                                          denseTile,
                                                          residualRow,
                                                          horizontalMoments,
                                                          verticalMoments,
                                                          selectedMoments,
                                                          solvePlanes,
                                                          judgePlanes,
                                                          sumRows};

}  // namespace softscope
