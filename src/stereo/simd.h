// src/stereo/simd.h: many values at a time, in whatever registers there are.
//
// For the files that are compiled once for each instruction set (kernel_sets.h): everything here is
// local to the file that includes it.
#pragma once

#include <cstdint>
#include <cstring>

// The name of what one set offers.
#define SOFTSCOPE_NAME_(name, set) name##_##set
#define SOFTSCOPE_NAME(name, set) SOFTSCOPE_NAME_(name, set)

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
inline Float8 squareRoot(Float8 x) {
  for (int i = 0; i < 8; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
}

/// Always in the same order, so that every instruction set gives the same bytes.
inline float sum8(Float8 x) {
  return ((x[0] + x[4]) + (x[2] + x[6])) + ((x[1] + x[5]) + (x[3] + x[7]));
}

/// 0, 1, … 7.
inline Float8 lanes8() { return Float8{0, 1, 2, 3, 4, 5, 6, 7}; }

// As many 16-bit values as a register holds: comparing and choosing is fast on whole registers
// only.
#ifdef __AVX2__
constexpr int kWordLanes = 16;
#else
constexpr int kWordLanes = 8;
#endif
using Words = std::uint16_t __attribute__((vector_size(2 * kWordLanes)));
using SignedWords = std::int16_t __attribute__((vector_size(2 * kWordLanes)));
using Bytes = std::uint8_t __attribute__((vector_size(2 * kWordLanes)));  // two in each word

template <class Vector, class Value>
inline Vector load(const Value* p) {
  Vector x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
template <class Vector, class Value>
inline void store(Value* p, Vector x) {
  std::memcpy(p, &x, sizeof x);
}
template <class Vector>
inline Vector least(Vector a, Vector b) {
  return a < b ? a : b;
}
template <class Vector>
inline Vector greatest(Vector a, Vector b) {
  return a > b ? a : b;
}

}  // namespace
}  // namespace softscope
