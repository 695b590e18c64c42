// src/core/small_solve.h: small symmetric systems
// with a fixed order of operations on CPU and GPU.
#pragma once

#include <cmath>

#include "core/hd.h"

namespace softscope {

/// Lower triangle of a symmetric N x N matrix, row by row: (i, j), j <= i, is at i (i + 1) / 2 + j.
constexpr int triangleSize(int n) { return n * (n + 1) / 2; }

/// In-place Cholesky factor with inverted diagonal.
/// False unless the matrix is positive definite.
template <int N, class Scalar>
SOFTSCOPE_HD inline bool factorSymmetric(Scalar (&a)[triangleSize(N)]) {
  for (int i = 0; i < N; ++i)
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

/// In-place solution with the result of factorSymmetric().
template <int N, class Scalar>
SOFTSCOPE_HD inline void solveSymmetric(const Scalar (&a)[triangleSize(N)], Scalar (&x)[N]) {
  for (int i = 0; i < N; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= a[i * (i + 1) / 2 + k] * x[k];
    x[i] *= a[i * (i + 1) / 2 + i];
  }
  for (int i = N - 1; i >= 0; --i) {
    for (int k = i + 1; k < N; ++k) x[i] -= a[k * (k + 1) / 2 + i] * x[k];
    x[i] *= a[i * (i + 1) / 2 + i];
  }
}

}  // namespace softscope
