// src/core/small_solve.h: a symmetric 6 x 6 system, in one order of operations for the CPU and the
// GPU.
#pragma once

#include <cmath>

#include "core/hd.h"

namespace softscope {

/// Lower triangle of a symmetric matrix, row by row: (i, j), j <= i, is at i (i + 1) / 2 + j.
constexpr int kSixTriangle = 21;

/// Cholesky factor in place, its diagonal inverted. False where the matrix is not positive
/// definite.
template <class Scalar>
SOFTSCOPE_HD inline bool factorSix(Scalar (&a)[kSixTriangle]) {
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      Scalar sum = a[i * (i + 1) / 2 + j];
      for (int k = 0; k < j; ++k) sum -= a[i * (i + 1) / 2 + k] * a[j * (j + 1) / 2 + k];
      if (j < i) {
        a[i * (i + 1) / 2 + j] = sum * a[j * (j + 1) / 2 + j];
      } else {
        if (!(sum > 0)) return false;
        a[i * (i + 1) / 2 + i] = 1 / std::sqrt(sum);
      }
    }
  return true;
}

/// Solves in place with what factorSix() gave.
template <class Scalar>
SOFTSCOPE_HD inline void solveSix(const Scalar (&a)[kSixTriangle], Scalar (&x)[6]) {
  for (int i = 0; i < 6; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= a[i * (i + 1) / 2 + k] * x[k];
    x[i] *= a[i * (i + 1) / 2 + i];
  }
  for (int i = 5; i >= 0; --i) {
    for (int k = i + 1; k < 6; ++k) x[i] -= a[k * (k + 1) / 2 + i] * x[k];
    x[i] *= a[i * (i + 1) / 2 + i];
  }
}

}  // namespace softscope
