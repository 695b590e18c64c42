// src/stereo/kernels/refinement_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/refinement_kernels.h"

#include "core/kernel_list.h"
#include "stereo/kernels/refinement_formulas.h"
#include "stereo/kernels/relief_formulas.h"
#include "stereo/kernels/simd.h"

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

/// Catmull-Rom through four pixels of a row, at fractions t after the columns i.
inline ValueAndSlope<Floats> valuesAt(const float* row, const Ints& i, const Floats& t) {
  Float4 pixels[kFloatLanes];
  for (int k = 0; k < kFloatLanes; ++k) pixels[k] = load<Float4>(row + i[k] - 1);
  const auto [p0, p1, p2, p3] = transpose(pixels).p;
  return catmullRom<Floats>(p0, p1, p2, p3, t);
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
    const Floats slow_left = loadFloats(row.slow_left + u);
    const Floats light =
        lightAt<Floats>(row.light, broadcast(static_cast<float>(u)) + laneNumbers(), slow_left);
    const ValueAndSlope<Floats> slow = agreedSlowPart<Floats>(
        valuesAt(row.slow_right, i, t), slow_left, light, row.limits.light_gray_sq);
    const PixelResidual<Floats> pixel = pixelResidual<Floats>(
        loadFloats(row.left + u), valuesAt(row.right, i, t), slow, inside, d, row.limits);
    store(row.information + u, pixel.information);
    store(row.target + u, pixel.target);
    if (row.weight == nullptr) continue;
    store(row.residual_sq + u, pixel.residual_sq);
    store(row.weight + u, pixel.weight);
    store(row.difference_sq + u, pixel.difference_sq);
    store(row.energy + u, pixel.energy);
  }
}

void columnMoments(const float* const* information, const float* const* target, const float* window,
                   int radius, int width, float* const* out) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats sums[kColumnMomentCount];
    columnMomentsOf([&](int y) { return loadFloats(information[radius + y] + u); },
                    [&](int y) { return loadFloats(target[radius + y] + u); }, window, radius,
                    sums);
    for (int k = 0; k < kColumnMomentCount; ++k) store(out[k] + u, sums[k]);
  }
}

void rowMoments(const float* const* in, const float* window, int radius, int width,
                const MomentRow& out) {
  for (int u = 0; u < width; u += kFloatLanes) {
    Floats sums[kFirstEvidence];
    windowMomentsOf([&](int k, int x) { return loadFloats(in[k] + u + x); }, window, radius, sums);
    for (int k = 0; k < kFirstEvidence; ++k) store(out.sums[k] + u, sums[k]);
  }
}

/// Whether the window at column u contains a pixel of another surface.
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

inline float sumLanes(const float* x) { return sumLanesOf(x, 1); }

/// Nine moments of a row, kFloatLanes columns.
inline void loadMoments(const MomentRow& moments, int u, Floats (&m)[kFirstEvidence]) {
  for (int k = 0; k < kFirstEvidence; ++k) m[k] = loadFloats(moments.sums[k] + u);
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

/// D of the 3 x 3 system by Cramer's rule; NaN for a degenerate window.
void solvePlanes(const PlaneRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    Floats m[kFirstEvidence];
    loadMoments(row.moments, u, m);
    store(row.disparity + u, planeDisparity(m, loadFloats(row.before + u), row.of_disparity,
                                            row.farthest_step_px, row.relaxation, broadcast(kNaN)));
  }
}

/// Standard errors of the results of solvePlanes(), NaN, and the disparity
/// too, if unreliable; and where the evidence is, if wanted.
void estimatePlaneErrors(const PlaneRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    Floats m[kFirstEvidence], evidence[kMomentCount - kFirstEvidence];
    loadMoments(row.moments, u, m);
    for (int k = kFirstEvidence; k < kMomentCount; ++k)
      evidence[k - kFirstEvidence] = loadFloats(row.moments.sums[k] + u);
    const Floats disparity = loadFloats(row.disparity + u);
    Ints holds;
    const Floats variance = planeVariance(
        m, evidence, disparity, row.prior_weight, row.noise_floor_sq, row.independent_pixels,
        row.model_variance_px2, row.max_variance_px2, row.max_difference, &holds);
    store(row.disparity + u, holds ? disparity : broadcast(kNaN));
    store(row.sigma + u, holds ? squareRoot(variance) : broadcast(kNaN));
    const Floats noise_sq = noiseOfWindow(evidence, row.noise_floor_sq);
    store(row.response + u,
          reliefResponse(evidenceShare(m[0], evidence[1], noise_sq, row.prior_weight)));
    if (row.beside == nullptr) continue;
    const EvidenceCentre<Floats> centre =
        evidenceCentre(m, evidence, row.prior_weight, row.noise_floor_sq);
    store(row.beside + u, centre.x);
    store(row.below + u, centre.y);
  }
}

void measureRelief(const ReliefRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    Floats relief_sq, noise_sq;
    reliefAndNoise(loadFloats(row.planes + u), loadFloats(row.disparity + u),
                   loadFloats(row.sigma + u), row.model_variance_px2, &relief_sq, &noise_sq);
    store(row.relief_sq + u, relief_sq);
    store(row.noise_sq + u, noise_sq);
  }
}

void shrinkRelief(const ReliefRow& row) {
  for (int u = 0; u < row.width; u += kFloatLanes) {
    const Floats planes = loadFloats(row.planes + u), sigma = loadFloats(row.sigma + u);
    const Floats gain = reliefGain(loadFloats(row.relief_sq + u), loadFloats(row.noise_sq + u));
    const Floats relief = loadFloats(row.disparity + u) - planes;
    store(row.disparity + u, planes + keptRelief(relief, loadFloats(row.smooth + u), gain));
    store(row.sigma + u,
          squareRoot(varianceWithRelief(sigma * sigma, gain, row.model_variance_px2)));
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
    residualRow, columnMoments,       rowMoments,    markMixed,    selectedMoments,
    solvePlanes, estimatePlaneErrors, measureRelief, shrinkRelief, sumRows};

}  // namespace softscope
