// src/stereo/simd.h: eight floats at a time, in whatever registers there are.
//
// For the files that are compiled once for each instruction set (kernel_sets.h): everything here is
// local to the file that includes it.
#pragma once

#include <cstring>

namespace softscope {
namespace {

using Float4 = float __attribute__((vector_size(16)));
using Float8 = float __attribute__((vector_size(32)));
using Int8 = int __attribute__((vector_size(32)));

// One unaligned instruction each.
inline Float8 load8(const float* p) {
  Float8 x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline void store8(float* p, Float8 x) { std::memcpy(p, &x, sizeof x); }

inline Float4 load4(const float* p) {
  Float4 x;
  std::memcpy(&x, p, sizeof x);
  return x;
}

inline Float8 broadcast8(float x) { return Float8{} + x; }
inline Float8 abs8(Float8 x) { return x < 0.0f ? -x : x; }

/// Always in the same order, so that every instruction set gives the same bytes.
inline float sum8(Float8 x) {
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/// 0, 1, … 7.
inline Float8 lanes8() { return Float8{0, 1, 2, 3, 4, 5, 6, 7}; }

}  // namespace
}  // namespace softscope
