// src/stereo/refinement_kernels.cpp: loops over eight pixels at a time, in whatever registers there
// are; SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/refinement_kernels.h"

#include <cstring>

#define SOFTSCOPE_NAME_(name, set) name##_##set
#define SOFTSCOPE_NAME(name, set) SOFTSCOPE_NAME_(name, set)

namespace softscope {
namespace {

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

extern const RefinementKernels SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET);
const RefinementKernels SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET) = {
    residualRow, horizontalMoments, verticalMoments, selectedMoments,
    solvePlanes, judgePlanes,       sumRows};

}  // namespace softscope
