// src/deform/kernels/warp_formulas.h: warping points by blended nodes: docs/energy.md (2), (24).
//
// For any vector V of four floats with +, * and []: a SIMD register on the CPU, a struct on the
// GPU.
#pragma once

#include "core/hd.h"
#include "deform/kernels/plane_term.h"

namespace softscope {

/// The blended displacement of one point: columns of A - I, then the offset.
template <class V>
struct Blend {
  V columns[4];
};

template <class V>
SOFTSCOPE_FORMULA void warpPosition(const Blend<V>& blend, const V& x, const V& y, const V& z,
                                    const float* in, float* out) {
  const V p = blend.columns[0] * x + blend.columns[1] * y + blend.columns[2] * z + blend.columns[3];
  const float moved[3] = {in[0] + p[0], in[1] + p[1], in[2] + p[2]};
  for (int i = 0; i < 3; ++i) out[i] = moved[i];
}

/// By the inverse transposed, up to a factor: the matrix of cofactors. `squareRoot(float)`.
template <class V, class SquareRoot>
SOFTSCOPE_FORMULA void warpNormal(const Blend<V>& blend, const float* in, float* out,
                                  const SquareRoot& squareRoot) {
  const V one = {1, 0, 0, 0}, two = {0, 1, 0, 0}, three = {0, 0, 1, 0};
  const V a = blend.columns[0] + one, b = blend.columns[1] + two, c = blend.columns[2] + three;
  const Vec3<float> c0 = {a[0], a[1], a[2]}, c1 = {b[0], b[1], b[2]}, c2 = {c[0], c[1], c[2]};
  const Vec3<float> k0 = cross(c1, c2), k1 = cross(c2, c0), k2 = cross(c0, c1);
  const float x = k0.x * in[0] + k1.x * in[1] + k2.x * in[2];
  const float y = k0.y * in[0] + k1.y * in[1] + k2.y * in[2];
  const float z = k0.z * in[0] + k1.z * in[1] + k2.z * in[2];
  const float squared = x * x + y * y + z * z;
  const bool usable = squared > 1e-20f && squared < 1e20f;
  const float factor = usable ? 1 / squareRoot(squared) : 0.0f;
  out[0] = usable ? x * factor : in[0];
  out[1] = usable ? y * factor : in[1];
  out[2] = usable ? z * factor : in[2];
}

}  // namespace softscope
