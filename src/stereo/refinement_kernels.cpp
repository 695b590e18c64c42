// src/stereo/refinement_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/refinement_kernels.h"

#include "stereo/simd.h"

namespace softscope {
namespace {

constexpr float kNaN = __builtin_nanf("");

/// Column k of the result: element k of each row.
struct Transposed {
  Float8 p[4];
};
inline Transposed transpose(const Float4 (&row)[8]) {
  Transposed out;
  for (int half = 0; half < 2; ++half) {
    const Float4 *r = row + 4 * half, a = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5),
                 b = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5),
                 c = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7),
                 d = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    const Float4 columns[4] = {
        __builtin_shufflevector(a, b, 0, 1, 4, 5), __builtin_shufflevector(a, b, 2, 3, 6, 7),
        __builtin_shufflevector(c, d, 0, 1, 4, 5), __builtin_shufflevector(c, d, 2, 3, 6, 7)};
    for (int k = 0; k < 4; ++k)
      std::memcpy(reinterpret_cast<char*>(&out.p[k]) + 16 * half, &columns[k], 16);
  }
  return out;
}

void residualRow(const ResidualRow& row) {
  const Float8 last = broadcast8(static_cast<float>(row.width - 1)), zero{};
  for (int u = 0; u < row.width; u += 8) {
    const Float8 given = load8(row.disparity + u);
    const Float8 d = given == given ? given : zero;
    Float8 x = broadcast8(static_cast<float>(u)) + lanes8() - given;  // NaN compares false
    const Float8 inside = ((x >= zero) & (x <= last)) ? broadcast8(1) : zero;
    x = x >= zero ? x : zero;
    x = x <= last ? x : last;
    const Int8 i = __builtin_convertvector(x, Int8);
    const Float8 t = x - __builtin_convertvector(i, Float8);
    // Catmull-Rom through four pixels: value and slope.
    Float4 pixels[8];
    for (int k = 0; k < 8; ++k) pixels[k] = load4(row.right + i[k] - 1);
    const auto [p0, p1, p2, p3] = transpose(pixels).p;
    const Float8 c1 = 0.5f * (p2 - p0), c2 = p0 - 2.5f * p1 + 2.0f * p2 - 0.5f * p3,
                 c3 = 1.5f * (p1 - p2) + 0.5f * (p3 - p0);
    const Float8 value = p1 + t * (c1 + t * (c2 + t * c3));
    const Float8 g = c1 + t * (2.0f * c2 + t * (3.0f * c3));
    const Float8 left = load8(row.left + u), r = value - left;
    const Float8 w = inside / (1.0f + r * r * row.inverse_noise_sq);
    store8(row.information + u, w * (g * g + row.prior_weight));
    store8(row.target + u, w * (g * (g * d + r) + row.prior_weight * d));
    if (row.weight == nullptr) continue;
    store8(row.residual_sq + u, w * r * r);
    store8(row.weight + u, w);
    store8(row.difference_sq + u, inside * r * r);
    store8(row.energy + u, inside * (value * value + left * left));
  }
}

// A window is symmetric: sums and differences of the pixels on either side of the centre serve the
// even and the odd moments.
void columnMoments(const float* const* information, const float* const* target, const float* window,
                   int radius, int width, float* const* out) {
  for (int u = 0; u < width; u += 8) {
    Float8 g0 = window[radius] * load8(information[radius] + u), g1{}, g2{};
    Float8 q0 = window[radius] * load8(target[radius] + u), q1{};
    for (int y = 1; y <= radius; ++y) {
      const float w = window[radius + y], fy = static_cast<float>(y), wy = w * fy, wyy = wy * fy;
      const Float8 g_above = load8(information[radius - y] + u),
                   g_below = load8(information[radius + y] + u),
                   q_above = load8(target[radius - y] + u), q_below = load8(target[radius + y] + u);
      const Float8 g = g_below + g_above, q = q_below + q_above;
      g0 += w * g;
      g1 += wy * (g_below - g_above);
      g2 += wyy * g;
      q0 += w * q;
      q1 += wy * (q_below - q_above);
    }
    const Float8 sums[kColumnMomentCount] = {g0, g1, g2, q0, q1};
    for (int k = 0; k < kColumnMomentCount; ++k) store8(out[k] + u, sums[k]);
  }
}

void rowMoments(const float* const* in, const float* window, int radius, int width,
                const MomentRow& out) {
  for (int u = 0; u < width; u += 8) {
    Float8 even[kColumnMomentCount], g_x{}, g_xx{}, g_xy{}, q_x{};
    for (int k = 0; k < kColumnMomentCount; ++k) even[k] = window[radius] * load8(in[k] + u);
    for (int x = 1; x <= radius; ++x) {
      const float w = window[radius + x], fx = static_cast<float>(x), wx = w * fx, wxx = wx * fx;
      Float8 before[kColumnMomentCount], after[kColumnMomentCount];
      for (int k = 0; k < kColumnMomentCount; ++k) {
        before[k] = load8(in[k] + u - x);
        after[k] = load8(in[k] + u + x);
        even[k] += w * (after[k] + before[k]);
      }
      g_x += wx * (after[0] - before[0]);
      g_xx += wxx * (after[0] + before[0]);
      g_xy += wx * (after[1] - before[1]);
      q_x += wx * (after[3] - before[3]);
    }
    const Float8 sums[kFirstEvidence] = {even[0], g_x,     even[1], g_xx,   g_xy,
                                         even[2], even[3], q_x,     even[4]};
    for (int k = 0; k < kFirstEvidence; ++k) store8(out.sums[k] + u, sums[k]);
  }
}

/// True where the window at column u holds a pixel of another surface.
bool mixesSurfaces(const SelectedRows& rows, int u, Float8 centre, Float8 scale) {
  Int8 found{};
  for (int y = 0; y <= 2 * rows.radius; ++y)
    for (int i = 0; i < kSelectLanes; i += 8)
      found |= abs8(load8(rows.disparity[y] + u - rows.radius + i) - centre) >
               scale * load8(rows.tolerance + y * kSelectLanes + i);
  int any = 0;
  for (int i = 0; i < 8; ++i) any |= found[i];
  return any != 0;
}

/// The nine moments of the plane.
void selectPlane(const SelectedRows& rows, int u, Float8 centre, Float8 scale,
                 const MomentRow& out) {
  float moments[kFirstEvidence] = {};
  for (int i = 0; i < kSelectLanes; i += 8) {
    Float8 g0{}, g1{}, g2{}, q0{}, q1{};
    for (int y = 0; y <= 2 * rows.radius; ++y) {
      const int at = u - rows.radius + i, k = y * kSelectLanes + i;
      const Float8 apart = abs8(load8(rows.disparity[y] + at) - centre);
      const Float8 w =
          apart <= scale * load8(rows.tolerance + k) ? load8(rows.window + k) : Float8{};
      const float fy = static_cast<float>(y - rows.radius);
      const Float8 g = w * load8(rows.information[y] + at), q = w * load8(rows.target[y] + at);
      g0 += g;
      g1 += fy * g;
      g2 += fy * fy * g;
      q0 += q;
      q1 += fy * q;
    }
    const Float8 x = lanes8() + static_cast<float>(i - rows.radius);
    const Float8 parts[] = {g0, x * g0, g1, x * x * g0, x * g1, g2, q0, x * q0, q1};
    for (int m = 0; m < kFirstEvidence; ++m) moments[m] += sum8(parts[m]);
  }
  for (int m = 0; m < kFirstEvidence; ++m) out.sums[m][u] = moments[m];
}

void selectEvidence(const SelectedRows& rows, int u, Float8 centre, Float8 scale,
                    const MomentRow& out) {
  float moments[4] = {};
  for (int i = 0; i < kSelectLanes; i += 8) {
    Float8 sums[4] = {};
    for (int y = 0; y <= 2 * rows.radius; ++y) {
      const int at = u - rows.radius + i, k = y * kSelectLanes + i;
      const Float8 apart = abs8(load8(rows.disparity[y] + at) - centre);
      const Float8 w =
          apart <= scale * load8(rows.tolerance + k) ? load8(rows.window + k) : Float8{};
      for (int m = 0; m < 4; ++m) sums[m] += w * load8(rows.evidence[m][y] + at);
    }
    for (int m = 0; m < 4; ++m) moments[m] += sum8(sums[m]);
  }
  for (int m = 0; m < 4; ++m) out.sums[kFirstEvidence + m][u] = moments[m];
}

void selectedMoments(const SelectedRows& rows, const int* columns, int count,
                     const MomentRow& out) {
  for (int i = 0; i < count; ++i) {
    const int u = columns[i];
    const Float8 centre = broadcast8(rows.disparity[rows.radius][u]);
    const Float8 scale = rows.relative ? centre : broadcast8(1);
    if (rows.mixed != nullptr) rows.mixed[u] = mixesSurfaces(rows, u, centre, scale);
    if (rows.mixed != nullptr && rows.mixed[u] == 0) continue;
    selectPlane(rows, u, centre, scale, out);
    if (rows.evidence[0] != nullptr) selectEvidence(rows, u, centre, scale, out);
  }
}

/// D of the 3 x 3 system by Cramer's rule; NaN where the window makes no plane.
void solvePlanes(const PlaneRow& row) {
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; u += 8) {
    const Float8 a = load8(m[0] + u), b = load8(m[1] + u), c = load8(m[2] + u), d = load8(m[3] + u),
                 e = load8(m[4] + u), f = load8(m[5] + u);
    const Float8 c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
    const Float8 determinant = a * c00 + b * c01 + c * c02;
    const Float8 found =
        (c00 * load8(m[6] + u) + c01 * load8(m[7] + u) + c02 * load8(m[8] + u)) / determinant;
    const Float8 before = load8(row.before + u), step = found - before;
    // Comparisons with NaN are false, so an unmatched pixel stays unmatched.
    const Int8 holds = (determinant > 1e-3f * a * d * f) & (abs8(step) < row.farthest_step_px);
    store8(row.disparity + u, holds ? before + row.relaxation * step : broadcast8(kNaN));
  }
}

/// Standard errors of what solvePlanes() found; NaN, and the disparity too, where it can't be
/// trusted.
void judgePlanes(const PlaneRow& row) {
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; u += 8) {
    const Float8 a = load8(m[0] + u), b = load8(m[1] + u), c = load8(m[2] + u), d = load8(m[3] + u),
                 e = load8(m[4] + u), f = load8(m[5] + u);
    const Float8 c00 = d * f - e * e;
    const Float8 determinant = a * c00 + b * (c * e - b * f) + c * (b * e - c * d);
    // The matched disparity steadies the fit but is no evidence: it doesn't lower the error.
    const Float8 weight = load8(m[10] + u), raw = 1.0f - row.prior_weight * weight / a;
    const Float8 evidence = raw > 1e-3f ? raw : broadcast8(1e-3f);
    const Float8 noise_sq = load8(m[9] + u) / weight + row.noise_floor_sq;
    const Float8 variance =
        noise_sq * (c00 / determinant) / (evidence * evidence * row.independent_pixels) +
        row.model_variance_px2;
    const Float8 disparity = load8(row.disparity + u);
    const Int8 holds = (disparity == disparity) & (variance <= row.max_variance_px2) &
                       (load8(m[11] + u) <= row.max_difference * load8(m[12] + u));
    store8(row.disparity + u, holds ? disparity : broadcast8(kNaN));
    store8(row.sigma + u, holds ? squareRoot(variance) : broadcast8(kNaN));
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
    residualRow, columnMoments, rowMoments, selectedMoments, solvePlanes, judgePlanes, sumRows};

}  // namespace softscope
