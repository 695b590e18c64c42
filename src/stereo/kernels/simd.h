// src/stereo/kernels/simd.h: SIMD values of any register width.
//
// For the files that are compiled once for each instruction set (stereo_kernels.h): everything here
// is local to the file that includes it.
#pragma once

#include <cstdint>
#include <cstring>

namespace softscope {
namespace {

// As many values as a register holds: comparison and selection are fast on
// whole registers only. Sums across lanes must not depend on their number.
#ifdef __AVX2__
constexpr int kFloatLanes = 8;
#else
constexpr int kFloatLanes = 4;
#endif
constexpr int kWordLanes = 2 * kFloatLanes;
using Float4 = float __attribute__((vector_size(16)));
using Floats = float __attribute__((vector_size(4 * kFloatLanes)));
using Ints = int __attribute__((vector_size(4 * kFloatLanes)));
using Words = std::uint16_t __attribute__((vector_size(2 * kWordLanes)));
using SignedWords = std::int16_t __attribute__((vector_size(2 * kWordLanes)));
using Bytes = std::uint8_t __attribute__((vector_size(2 * kWordLanes)));  // two in each word

// One unaligned instruction each.
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
inline Floats loadFloats(const float* p) { return load<Floats>(p); }

template <class Vector>
inline Vector least(Vector a, Vector b) {
  return a < b ? a : b;
}
template <class Vector>
inline Vector greatest(Vector a, Vector b) {
  return a > b ? a : b;
}

inline Floats broadcast(float x) { return Floats{} + x; }
inline Floats absolute(Floats x) { return x < 0.0f ? -x : x; }
inline Floats squareRoot(Floats x) {
  for (int i = 0; i < kFloatLanes; ++i) x[i] = __builtin_sqrtf(x[i]);
  return x;
}

/// 0, 1, 2, …
inline Floats laneNumbers() {
  Floats x{};
  for (int i = 0; i < kFloatLanes; ++i) x[i] = static_cast<float>(i);
  return x;
}

}  // namespace
}  // namespace softscope
