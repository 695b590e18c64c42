// src/stereo/kernels/refinement_formulas.h: formulas of residuals, window moments, planes and
// normals, for one pixel on the GPU or one SIMD register of pixels on the CPU.
//
// V: float, or a vector of floats; masks come from comparisons of V. Never contracted.
#pragma once

#include "core/hd.h"
#include "stereo/kernels/refinement_kernels.h"
#include "stereo/options/stereo_options.h"

namespace softscope {

/// Brightness of the right image and its slope at fraction t between the pixels p1 and p2, by
/// Catmull-Rom.
template <class V>
struct ValueAndSlope {
  V value, slope;
};
template <class V>
SOFTSCOPE_FORMULA ValueAndSlope<V> catmullRom(V p0, V p1, V p2, V p3, V t) {
  const V c1 = 0.5f * (p2 - p0), c2 = p0 - 2.5f * p1 + 2.0f * p2 - 0.5f * p3,
          c3 = 1.5f * (p1 - p2) + 0.5f * (p3 - p0);
  return {p1 + t * (c1 + t * (c2 + t * c3)), c1 + t * (2.0f * c2 + t * (3.0f * c3))};
}

/// Share of the low-pass brightness that is not of a highlight: none of what is white. Highlights
/// are mirror images of the light, behind or before the tissue, and their slopes are large.
template <class V>
SOFTSCOPE_FORMULA V diffuseShare(V slow_left, V slow_right) {
  constexpr float kWhite = 255;
  const V brightest = slow_left > slow_right ? slow_left : slow_right;
  const V white = brightest * (1 / kWhite), share = 1.0f - white * white * white;
  return share > 0.0f ? share : V{};
}

/// Low-pass brightness of the right camera, as far as it is of tissue and both cameras agree: less
/// where they differ by more than light_gray and the effect of a pixel of disparity.
template <class V>
SOFTSCOPE_FORMULA ValueAndSlope<V> agreedSlowPart(const ValueAndSlope<V>& right, V left, V light,
                                                  float light_gray_sq) {
  const V apart = right.value - left - light;
  const V q = 1.0f + apart * apart / (light_gray_sq + right.slope * right.slope);
  const V agreed = diffuseShare(left, right.value) / (q * q);
  return {agreed * apart, agreed * right.slope};
}

/// Fields of ResidualRow for one pixel. `slow`: result of
/// agreedSlowPart(). `inside`: 1 if the pixel is matched,
/// otherwise 0; `d`: its disparity, 0 if unmatched.
template <class V>
struct PixelResidual {
  V information, target, residual_sq, weight, difference_sq, energy;
};
template <class V>
SOFTSCOPE_FORMULA PixelResidual<V> pixelResidual(V left, const ValueAndSlope<V>& right,
                                                 const ValueAndSlope<V>& slow, V inside, V d,
                                                 const ResidualLimits& limits) {
  const float prior_weight = limits.prior_weight;
  const V value = right.value + slow.value, g = right.slope + slow.slope, r = value - left;
  const V w = inside / (1.0f + r * r * limits.inverse_noise_sq);
  // The error counts the information of the low-pass part in part only, and not the prior.
  const V linear = limits.of_disparity * d;  // the planes fit it
  const V told = g * g - right.slope * right.slope;
  const V judged = w * (1.0f + (told > 0.0f ? told : V{}) * limits.steadying);
  return {w * (g * g + prior_weight),
          w * (g * (g * linear + r) + prior_weight * linear),
          judged * r * r,
          judged,
          inside * r * r,
          inside * (value * value + left * left)};
}

/// Sums along one column of a window: kColumnMomentCount values. information(y) and target(y) give
/// the pixel y rows below the centre. A window is symmetric: sums and differences of the pixels on
/// either side of the centre serve the even and the odd moments.
template <class V, class Information, class Target>
SOFTSCOPE_FORMULA void columnMomentsOf(const Information& information, const Target& target,
                                       const float* window, int radius, V (&sums)[5]) {
  V g0 = window[radius] * information(0), g1{}, g2{};
  V q0 = window[radius] * target(0), q1{};
  for (int y = 1; y <= radius; ++y) {
    const float w = window[radius + y], fy = static_cast<float>(y), wy = w * fy, wyy = wy * fy;
    const V g_above = information(-y), g_below = information(y), q_above = target(-y),
            q_below = target(y);
    const V g = g_below + g_above, q = q_below + q_above;
    g0 += w * g;
    g1 += wy * (g_below - g_above);
    g2 += wyy * g;
    q0 += w * q;
    q1 += wy * (q_below - q_above);
  }
  sums[0] = g0;
  sums[1] = g1;
  sums[2] = g2;
  sums[3] = q0;
  sums[4] = q1;
}

/// Sums over the window from the sums of its columns:
/// column(k, x) gives moment k, x columns right of the centre.
template <class V, class Column>
SOFTSCOPE_FORMULA void windowMomentsOf(const Column& column, const float* window, int radius,
                                       V (&sums)[9]) {
  V even[5], g_x{}, g_xx{}, g_xy{}, q_x{};
  for (int k = 0; k < 5; ++k) even[k] = window[radius] * column(k, 0);
  for (int x = 1; x <= radius; ++x) {
    const float w = window[radius + x], fx = static_cast<float>(x), wx = w * fx, wxx = wx * fx;
    V before[5], after[5];
    for (int k = 0; k < 5; ++k) {
      before[k] = column(k, -x);
      after[k] = column(k, x);
      even[k] += w * (after[k] + before[k]);
    }
    g_x += wx * (after[0] - before[0]);
    g_xx += wxx * (after[0] + before[0]);
    g_xy += wx * (after[1] - before[1]);
    q_x += wx * (after[3] - before[3]);
  }
  sums[0] = even[0];
  sums[1] = g_x;
  sums[2] = even[1];
  sums[3] = g_xx;
  sums[4] = g_xy;
  sums[5] = even[2];
  sums[6] = even[3];
  sums[7] = q_x;
  sums[8] = even[4];
}

/// Disparity by Cramer's rule from the nine moments, of the disparity or its difference: see
/// ResidualLimits. `nan` for a degenerate window.
template <class V>
SOFTSCOPE_FORMULA V planeDisparity(const V (&m)[9], V before, float of_disparity,
                                   float farthest_step_px, float relaxation, V nan) {
  const V a = m[0], b = m[1], c = m[2], d = m[3], e = m[4], f = m[5];
  const V c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d;
  const V determinant = a * c00 + b * c01 + c * c02;
  const V found = (c00 * m[6] + c01 * m[7] + c02 * m[8]) / determinant;
  const V step = found - of_disparity * before, apart = step < 0.0f ? -step : step;
  // Comparisons with NaN are false, so an unmatched pixel stays unmatched.
  const auto holds = (determinant > 1e-3f * a * d * f) & (apart < farthest_step_px);
  return holds ? before + relaxation * step : nan;
}

/// Squared slope of the right image's noise over the squared noise of the difference of
/// both images: half of that is the right one's, its central difference keeps half, and
/// the 3 x 3 filter, by which pixels two apart share a sixth of their noise, five sixths.
constexpr float kSlopeNoise = 0.5f * 0.5f * 5.0f / 6.0f;

/// Squared noise of the residuals in a window.
template <class V>
SOFTSCOPE_FORMULA V noiseOfWindow(const V (&evidence_sums)[4], float noise_floor_sq) {
  return evidence_sums[0] / evidence_sums[1] + noise_floor_sq;
}

/// Share of the information that is evidence. The stabilising term, the matched disparity and the
/// slope of noise are none: they do not lower the error.
template <class V>
SOFTSCOPE_FORMULA V evidenceShare(V information, V weight, V noise_sq, float prior_weight) {
  const V share = 1.0f - (prior_weight + kSlopeNoise * noise_sq) * weight / information;
  return share > 1e-3f ? share : V{} + 1e-3f;
}

/// Centre of gravity of a window's evidence, in pixels from the centre of the window.
template <class V>
struct EvidenceCentre {
  V x, y;
};
template <class V>
SOFTSCOPE_FORMULA EvidenceCentre<V> evidenceCentre(const V (&m)[9], const V (&evidence_sums)[4],
                                                   float prior_weight, float noise_floor_sq) {
  const V noise_sq = noiseOfWindow(evidence_sums, noise_floor_sq);
  const V evidence = m[0] * evidenceShare(m[0], evidence_sums[1], noise_sq, prior_weight);
  return {m[1] / evidence, m[2] / evidence};
}

/// Variance of planeDisparity() from the moments and residual_sq and
/// weight, and whether the fit is reliable, given difference_sq and energy.
template <class V, class Mask>
SOFTSCOPE_FORMULA V planeVariance(const V (&m)[9], const V (&evidence_sums)[4], V disparity,
                                  float prior_weight, float noise_floor_sq,
                                  float independent_pixels, float model_variance_px2,
                                  float max_variance_px2, float max_difference, Mask* holds) {
  const V a = m[0], b = m[1], c = m[2], d = m[3], e = m[4], f = m[5];
  const V c00 = d * f - e * e;
  const V determinant = a * c00 + b * (c * e - b * f) + c * (b * e - c * d);
  const V noise_sq = noiseOfWindow(evidence_sums, noise_floor_sq);
  const V evidence = evidenceShare(a, evidence_sums[1], noise_sq, prior_weight);
  const V variance = noise_sq * (c00 / determinant) / (evidence * evidence * independent_pixels) +
                     model_variance_px2;
  *holds = (disparity == disparity) & (variance <= max_variance_px2) &
           (evidence_sums[2] <= max_difference * evidence_sums[3]);
  return variance;
}

/// Sixteen lanes in the order of selectedMoments(), on every instruction set and on the GPU.
SOFTSCOPE_FORMULA float sumLanesOf(const float* x, int stride) {
  float four[4];
  for (int i = 0; i < 4; ++i)
    four[i] = (x[i * stride] + x[(i + 8) * stride]) + (x[(i + 4) * stride] + x[(i + 12) * stride]);
  return (four[0] + four[2]) + (four[1] + four[3]);
}

// Planes fitted to the inverse depth.
constexpr int kNormalReach = 3;            // pixels
constexpr float kNormalDepthStep = 0.05f;  // share of the depth: beyond it another surface
constexpr float kFewestNormalPixels = 12;  // of 49, for a plane

/// Normal of the plane through inverse depths, not normalised, towards the camera
/// after scaling by a negative factor. `u_cx`, `v_cy`: pixel minus principal point.
template <class V>
struct PlaneNormal {
  V x, y, z, determinant;
};
template <class V>
SOFTSCOPE_FORMULA PlaneNormal<V> planeNormal(const V (&m)[9], V u_cx, float v_cy, float fx_px,
                                             float fy_px) {
  const V a = m[0], b = m[1], c = m[2], d = m[3], e = m[4], f = m[5];
  const V w = m[6], xw = m[7], yw = m[8];
  // The adjugate times the right side: the plane up to a positive factor.
  const V c00 = d * f - e * e, c01 = c * e - b * f, c02 = b * e - c * d, c11 = a * f - c * c,
          c12 = b * c - a * e, c22 = a * d - b * b;
  const V determinant = a * c00 + b * c01 + c * c02;
  const V p0 = c00 * w + c01 * xw + c02 * yw, pu = c01 * w + c11 * xw + c12 * yw,
          pv = c02 * w + c12 * xw + c22 * yw;
  return {pu * fx_px, pv * fy_px, p0 - pu * u_cx - pv * v_cy, determinant};
}

}  // namespace softscope
