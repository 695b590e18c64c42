// src/deform/kernels/plane_term.h: the residual of one point against one plane, and its Jacobian
// row.
//
// Back-projection is one such row, a matched key point three (docs/energy.md (8), (12)). Written
// without Eigen, for any V with + - *: double on the CPU, float on the GPU, four nodes side by side
// in a SIMD register. Always inlined, so that no instruction set leaks out of its own object file.
#pragma once

#include "core/hd.h"

namespace softscope {

template <class V>
struct Vec3 {
  V x, y, z;
};

template <class V>
SOFTSCOPE_FORMULA Vec3<V> subtract(const Vec3<V>& a, const Vec3<V>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
SOFTSCOPE_FORMULA Vec3<V> scale(const Vec3<V>& a, const V& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class V>
SOFTSCOPE_FORMULA V dot(const Vec3<V>& a, const Vec3<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
SOFTSCOPE_FORMULA Vec3<V> cross(const Vec3<V>& a, const Vec3<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A d, with A row by row.
template <class V>
SOFTSCOPE_FORMULA Vec3<V> multiply(const V* linear, const Vec3<V>& d) {
  return {linear[0] * d.x + linear[1] * d.y + linear[2] * d.z,
          linear[3] * d.x + linear[4] * d.y + linear[5] * d.z,
          linear[6] * d.x + linear[7] * d.y + linear[8] * d.z};
}

/// Contribution of one node to n . (warped point - target): docs/energy.md
/// (8). The contributions of the nodes of a stencil sum up to the residual,
/// because their weights sum up to 1. `turned` = A (p - g), `moved` = g + t.
template <class V>
SOFTSCOPE_FORMULA V planeShare(const Vec3<V>& turned, const Vec3<V>& moved, const Vec3<V>& target,
                               const Vec3<V>& normal, const V& weight) {
  const Vec3<V> away = {turned.x + moved.x - target.x, turned.y + moved.y - target.y,
                        turned.z + moved.z - target.z};
  return weight * dot(normal, away);
}

/// d residual / d (omega, delta t) of a rigid node: docs/energy.md (20).
template <class V>
SOFTSCOPE_FORMULA void rigidPlaneRow(const Vec3<V>& turned, const Vec3<V>& normal, const V& weight,
                                     V* row) {
  const Vec3<V> weighted = scale(normal, weight);
  const Vec3<V> torque = cross(turned, weighted);
  row[0] = torque.x;
  row[1] = torque.y;
  row[2] = torque.z;
  row[3] = weighted.x;
  row[4] = weighted.y;
  row[5] = weighted.z;
}

/// d residual / d (A column by column, t) of an affine node: docs/energy.md (21).
/// `offset` = p - g.
template <class V>
SOFTSCOPE_FORMULA void affinePlaneRow(const Vec3<V>& offset, const Vec3<V>& normal, const V& weight,
                                      V* row) {
  const Vec3<V> weighted = scale(normal, weight);
  const V lever[3] = {offset.x, offset.y, offset.z};
  for (int column = 0; column < 3; ++column) {
    row[3 * column + 0] = lever[column] * weighted.x;
    row[3 * column + 1] = lever[column] * weighted.y;
    row[3 * column + 2] = lever[column] * weighted.z;
  }
  row[9] = weighted.x;
  row[10] = weighted.y;
  row[11] = weighted.z;
}

}  // namespace softscope
