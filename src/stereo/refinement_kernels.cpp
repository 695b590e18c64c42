// src/stereo/refinement_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/refinement_kernels.h"

#include "stereo/simd.h"

namespace softscope {
namespace {

constexpr float kNaN = __builtin_nanf("");

/// Column k of the result: element k of each row.
struct Transposed {
  Floats p[4];
};
inline Transposed transpose(const Float4 (&row)[kFloatLanes]) {
  Transposed out;
  for (int part = 0; part < kFloatLanes / 4; ++part) {
    const Float4 *r = row + 4 * part, a = __builtin_shufflevector(r[0], r[1], 0, 4, 1, 5),
                 b = __builtin_shufflevector(r[2], r[3], 0, 4, 1, 5),
                 c = __builtin_shufflevector(r[0], r[1], 2, 6, 3, 7),
                 d = __builtin_shufflevector(r[2], r[3], 2, 6, 3, 7);
    const Float4 columns[4] = {
        __builtin_shufflevector(a, b, 0, 1, 4, 5), __builtin_shufflevector(a, b, 2, 3, 6, 7),
        __builtin_shufflevector(c, d, 0, 1, 4, 5), __builtin_shufflevector(c, d, 2, 3, 6, 7)};
    for (int k = 0; k < 4; ++k)
      std::memcpy(reinterpret_cast<char*>(&out.p[k]) + 16 * part, &columns[k], 16);
  }
  return out;
}

void residualRow(const ResidualRow& row) {
  const Floats last = broadcast(static_cast<float>(row.width - 1)), zero{};
  for (int u = 0; u < row.width; u += kFloatLanes) {
    const Floats given = loadFloats(row.disparity + u);
    const Floats d = given == given ? given : zero;
    Floats x = broadcast(static_cast<float>(u)) + laneNumbers() - given;  // NaN compares false
    const Floats inside = ((x >= zero) & (x <= last)) ? broadcast(1) : zero;
    x = x >= zero ? x : zero;
    x = x <= last ? x : last;
    const Ints i = __builtin_convertvector(x, Ints);
    const Floats t = x - __builtin_convertvector(i, Floats);
    // Catmull-Rom through four pixels: value and slope.
    Float4 pixels[kFloatLanes];
    for (int k = 0; k < kFloatLanes; ++k) pixels[k] = load<Float4>(row.right + i[k] - 1);
    const auto [p0, p1, p2, p3] = transpose(pixels).p;
    const Floats c1 = 0.5f * (p2 - p0), c2 = p0 - 2.5f * p1 + 2.0f * p2 - 0.5f * p3,
                 c3 = 1.5f * (p1 - p2) + 0.5f * (p3 - p0);
    const Floats value = p1 + t * (c1 + t * (c2 + t * c3));
    const Floats g = c1 + t * (2.0f * c2 + t * (3.0f * c3));
    const Floats left = loadFloats(row.left + u), r = value - left;
    const Floats w = inside / (1.0f + r * r * row.inverse_noise_sq);
    store(row.information + u, w * (g * g + row.prior_weight));
    store(row.target + u, w * (g * (g * d + r) + row.prior_weight * d));
    if (row.weight == nullptr) continue;
    store(row.residual_sq + u, w * r * r);
    store(row.weight + u, w);
    store(row.difference_sq + u, inside * r * r);
    store(row.energy + u, inside * (value * value + left * left));
  }
}

// A window is symmetric: sums and differences of the pixels on either side of the centre serve the
// even and the odd moments.
void columnMoments(const float* const* information, const float* const* target, const float* window,
                   int radius, int width, float* const* out) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats g0 = window[radius] * loadFloats(information[radius] + u), g1{}, g2{};
    Floats q0 = window[radius] * loadFloats(target[radius] + u), q1{};
    for (int y = 1; y <= radius; ++y) {
      const float w = window[radius + y], fy = static_cast<float>(y), wy = w * fy, wyy = wy * fy;
      const Floats g_above = loadFloats(information[radius - y] + u),
                   g_below = loadFloats(information[radius + y] + u),
                   q_above = loadFloats(target[radius - y] + u),
                   q_below = loadFloats(target[radius + y] + u);
      const Floats g = g_below + g_above, q = q_below + q_above;
      g0 += w * g;
      g1 += wy * (g_below - g_above);
      g2 += wyy * g;
      q0 += w * q;
      q1 += wy * (q_below - q_above);
    }
    const Floats sums[kColumnMomentCount] = {g0, g1, g2, q0, q1};
    for (int k = 0; k < kColumnMomentCount; ++k) store(out[k] + u, sums[k]);
  }
}

void rowMoments(const float* const* in, const float* window, int radius, int width,
                const MomentRow& out) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats even[kColumnMomentCount], g_x{}, g_xx{}, g_xy{}, q_x{};
    for (int k = 0; k < kColumnMomentCount; ++k) even[k] = window[radius] * loadFloats(in[k] + u);
    for (int x = 1; x <= radius; ++x) {
      const float w = window[radius + x], fx = static_cast<float>(x), wx = w * fx, wxx = wx * fx;
      Floats before[kColumnMomentCount], after[kColumnMomentCount];
      for (int k = 0; k < kColumnMomentCount; ++k) {
        before[k] = loadFloats(in[k] + u - x);
        after[k] = loadFloats(in[k] + u + x);
        even[k] += w * (after[k] + before[k]);
      }
      g_x += wx * (after[0] - before[0]);
      g_xx += wxx * (after[0] + before[0]);
      g_xy += wx * (after[1] - before[1]);
      q_x += wx * (after[3] - before[3]);
    }
    const Floats sums[kFirstEvidence] = {even[0], g_x,     even[1], g_xx,   g_xy,
                                         even[2], even[3], q_x,     even[4]};
    for (int k = 0; k < kFirstEvidence; ++k) store(out.sums[k] + u, sums[k]);
  }
}

/// True where the window at column u holds a pixel of another surface.
bool mixesSurfaces(const SelectedRows& rows, int u, Floats centre, Floats scale) {
  Ints found{};
  for (int y = 0; y <= 2 * rows.radius; ++y)
    for (int i = 0; i < kSelectLanes; i += kFloatLanes)
      found |= absolute(loadFloats(rows.disparity[y] + u - rows.radius + i) - centre) >
               scale * loadFloats(rows.tolerance + y * kSelectLanes + i);
  int any = 0;
  for (int i = 0; i < kFloatLanes; ++i) any |= found[i];
  return any != 0;
}

/// Always in the same order, so that every instruction set gives the same bytes.
inline float sumLanes(const float* x) {
  float eight[8], four[4];
  for (int i = 0; i < 8; ++i) eight[i] = x[i] + x[i + 8];
  for (int i = 0; i < 4; ++i) four[i] = eight[i] + eight[i + 4];
  return (four[0] + four[2]) + (four[1] + four[3]);
}

/// The nine moments of the plane.
void selectPlane(const SelectedRows& rows, int u, Floats centre, Floats scale,
                 const MomentRow& out) {
  float moments[kFirstEvidence][kSelectLanes];
  for (int i = 0; i < kSelectLanes; i += kFloatLanes) {
    Floats g0{}, g1{}, g2{}, q0{}, q1{};
    for (int y = 0; y <= 2 * rows.radius; ++y) {
      const int at = u - rows.radius + i, k = y * kSelectLanes + i;
      const Floats apart = absolute(loadFloats(rows.disparity[y] + at) - centre);
      const Floats w =
          apart <= scale * loadFloats(rows.tolerance + k) ? loadFloats(rows.window + k) : Floats{};
      const float fy = static_cast<float>(y - rows.radius);
      const Floats g = w * loadFloats(rows.information[y] + at),
                   q = w * loadFloats(rows.target[y] + at);
      g0 += g;
      g1 += fy * g;
      g2 += fy * fy * g;
      q0 += q;
      q1 += fy * q;
    }
    const Floats x = laneNumbers() + static_cast<float>(i - rows.radius);
    const Floats parts[] = {g0, x * g0, g1, x * x * g0, x * g1, g2, q0, x * q0, q1};
    for (int m = 0; m < kFirstEvidence; ++m) store(moments[m] + i, parts[m]);
  }
  for (int m = 0; m < kFirstEvidence; ++m) out.sums[m][u] = sumLanes(moments[m]);
}

void selectEvidence(const SelectedRows& rows, int u, Floats centre, Floats scale,
                    const MomentRow& out) {
  float moments[4][kSelectLanes];
  for (int i = 0; i < kSelectLanes; i += kFloatLanes) {
    Floats sums[4] = {};
    for (int y = 0; y <= 2 * rows.radius; ++y) {
      const int at = u - rows.radius + i, k = y * kSelectLanes + i;
      const Floats apart = absolute(loadFloats(rows.disparity[y] + at) - centre);
      const Floats w =
          apart <= scale * loadFloats(rows.tolerance + k) ? loadFloats(rows.window + k) : Floats{};
      for (int m = 0; m < 4; ++m) sums[m] += w * loadFloats(rows.evidence[m][y] + at);
    }
    for (int m = 0; m < 4; ++m) store(moments[m] + i, sums[m]);
  }
  for (int m = 0; m < 4; ++m) out.sums[kFirstEvidence + m][u] = sumLanes(moments[m]);
}

inline Floats centreOf(const SelectedRows& rows, int u) {
  return broadcast(rows.disparity[rows.radius][u]);
}
inline Floats scaleOf(const SelectedRows& rows, Floats centre) {
  return rows.relative ? centre : broadcast(1);
}

void markMixed(const SelectedRows& rows, const int* columns, int count, unsigned char* mixed) {
  for (int i = 0; i < count; ++i) {
    const Floats centre = centreOf(rows, columns[i]);
    mixed[columns[i]] = mixesSurfaces(rows, columns[i], centre, scaleOf(rows, centre));
  }
}

void selectedMoments(const SelectedRows& rows, const int* columns, int count,
                     const MomentRow& out) {
  for (int i = 0; i < count; ++i) {
    const Floats centre = centreOf(rows, columns[i]), scale = scaleOf(rows, centre);
    selectPlane(rows, columns[i], centre, scale, out);
    if (rows.evidence[0] != nullptr) selectEvidence(rows, columns[i], centre, scale, out);
  }
}

/// D of the 3 x 3 system by Cramer's rule; NaN where the window makes no plane.
void solvePlanes(const PlaneRow& row) {
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; u += kFloatLanes) {
    const Floats a = loadFloats(m[0] + u), b = loadFloats(m[1] + u), c = loadFloats(m[2] + u),
                 d = loadFloats(m[3] + u), e = loadFloats(m[4] + u), f = loadFloats(m[5] + u);
    const Floats c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
    const Floats determinant = a * c00 + b * c01 + c * c02;
    const Floats found =
        (c00 * loadFloats(m[6] + u) + c01 * loadFloats(m[7] + u) + c02 * loadFloats(m[8] + u)) /
        determinant;
    const Floats before = loadFloats(row.before + u), step = found - before;
    // Comparisons with NaN are false, so an unmatched pixel stays unmatched.
    const Ints holds = (determinant > 1e-3f * a * d * f) & (absolute(step) < row.farthest_step_px);
    store(row.disparity + u, holds ? before + row.relaxation * step : broadcast(kNaN));
  }
}

/// Standard errors of what solvePlanes() found; NaN, and the disparity too, where it can't be
/// trusted.
void judgePlanes(const PlaneRow& row) {
  const auto& m = row.moments.sums;
  for (int u = 0; u < row.width; u += kFloatLanes) {
    const Floats a = loadFloats(m[0] + u), b = loadFloats(m[1] + u), c = loadFloats(m[2] + u),
                 d = loadFloats(m[3] + u), e = loadFloats(m[4] + u), f = loadFloats(m[5] + u);
    const Floats c00 = d * f - e * e;
    const Floats determinant = a * c00 + b * (c * e - b * f) + c * (b * e - c * d);
    // The matched disparity steadies the fit but is no evidence: it doesn't lower the error.
    const Floats weight = loadFloats(m[10] + u), raw = 1.0f - row.prior_weight * weight / a;
    const Floats evidence = raw > 1e-3f ? raw : broadcast(1e-3f);
    const Floats noise_sq = loadFloats(m[9] + u) / weight + row.noise_floor_sq;
    const Floats variance =
        noise_sq * (c00 / determinant) / (evidence * evidence * row.independent_pixels) +
        row.model_variance_px2;
    const Floats disparity = loadFloats(row.disparity + u);
    const Ints holds = (disparity == disparity) & (variance <= row.max_variance_px2) &
                       (loadFloats(m[11] + u) <= row.max_difference * loadFloats(m[12] + u));
    store(row.disparity + u, holds ? disparity : broadcast(kNaN));
    store(row.sigma + u, holds ? squareRoot(variance) : broadcast(kNaN));
  }
}

void sumRows(const float* const* in, const float* weights, int taps, int width, float* out) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats sum{};
    for (int t = 0; t < taps; ++t) sum += weights[t] * loadFloats(in[t] + u);
    store(out + u, sum);
  }
}

}  // namespace

extern const RefinementKernels SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET);
const RefinementKernels SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET) = {
    residualRow,     columnMoments, rowMoments,  markMixed,
    selectedMoments, solvePlanes,   judgePlanes, sumRows};

}  // namespace softscope
