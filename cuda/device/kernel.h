// cuda/device/kernel.h: what a kernel body is made of, for the GPU and for the host executor.
//
// A kernel is a struct with its arguments as members and
//   static constexpr int kThreads;  // of a block
//   static constexpr int kPhases;   // parts between barriers of the block
//   struct Shared;                  // of the block
//   struct Local;                   // of a thread, kept across barriers
//   template <int kPhase> SOFTSCOPE_HD void run(const Place&, Shared&, Local&) const;
// Optional: int repeats(const Place&) const, how often a block runs all its phases at most, and
// bool isOver(const Shared&) const, whether it ends before the next repeat; the first phase may not
// change the answer. Neither order of threads nor order of blocks may change a result.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/hd.h"

namespace softscope::cuda {

/// Blocks of a launch.
struct Grid {
  int x = 1, y = 1, z = 1;
};

constexpr int blocksFor(int count, int per_block) { return (count + per_block - 1) / per_block; }

/// Where a thread is.
struct Place {
  int x, y, z;  // block
  int thread;   // in its block
  int repeat;   // of the block's phases
  Grid grid;
};

/// Before a loop: loads of several rounds run ahead of a chain of sums.
#ifdef __CUDA_ARCH__
#define SOFTSCOPE_PRAGMA(text) _Pragma(#text)
#define SOFTSCOPE_UNROLL(count) SOFTSCOPE_PRAGMA(unroll count)
#else
#define SOFTSCOPE_UNROLL(count)
#endif

/// For kernels without shared memory, or without values that outlive a phase.
struct Nothing {};

/// An image in memory of the device or the host; owns nothing.
template <class T>
struct View {
  T* data = nullptr;
  int width = 0, height = 0, stride = 0;

  SOFTSCOPE_HD T* row(int v) const { return data + static_cast<std::ptrdiff_t>(v) * stride; }
  SOFTSCOPE_HD T& at(int u, int v) const { return row(v)[u]; }
  SOFTSCOPE_HD bool contains(int u, int v) const {
    return u >= 0 && v >= 0 && u < width && v < height;
  }
};

template <class T>
View<const T> readOnly(const View<T>& view) {
  return {view.data, view.width, view.height, view.stride};
}

// Atomic on the device; on the host one thread runs at a time.
#ifdef __CUDA_ARCH__
#define SOFTSCOPE_ATOMIC(device, host) device
#else
#define SOFTSCOPE_ATOMIC(device, host) host
#endif
template <class T>
SOFTSCOPE_HD inline T atomicLeast(T* at, T value) {
  SOFTSCOPE_ATOMIC(return atomicMin(at, value), const T old = *at; if (value < old)* at = value;
                   return old);
}
template <class T>
SOFTSCOPE_HD inline T atomicGreatest(T* at, T value) {
  SOFTSCOPE_ATOMIC(return atomicMax(at, value), const T old = *at; if (value > old)* at = value;
                   return old);
}
template <class T>
SOFTSCOPE_HD inline T atomicPlus(T* at, T value) {
  SOFTSCOPE_ATOMIC(return atomicAdd(at, value), const T old = *at; *at = old + value; return old);
}
/// Writes `value` where `expected` was; returns what was there.
SOFTSCOPE_HD inline unsigned long long atomicClaim(unsigned long long* at,
                                                   unsigned long long expected,
                                                   unsigned long long value) {
  SOFTSCOPE_ATOMIC(return atomicCAS(at, expected, value), const unsigned long long old = *at;
                   if (old == expected)* at = value; return old);
}
SOFTSCOPE_HD inline void atomicUnite(std::uint32_t* at, std::uint32_t bits) {
  SOFTSCOPE_ATOMIC(atomicOr(at, bits), *at |= bits);
}
#undef SOFTSCOPE_ATOMIC

/// Sum of the absolute differences of four pairs of bytes, added to `sum`.
SOFTSCOPE_HD inline std::uint32_t byteDifferences(std::uint32_t a, std::uint32_t b,
                                                  std::uint32_t sum) {
#ifdef __CUDA_ARCH__
  return __vsadu4(a, b) + sum;
#else
  for (int shift = 0; shift < 32; shift += 8) {
    const int x = static_cast<int>(a >> shift & 255), y = static_cast<int>(b >> shift & 255);
    sum += static_cast<std::uint32_t>(x > y ? x - y : y - x);
  }
  return sum;
#endif
}

SOFTSCOPE_HD inline int countBits(std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  return __popc(bits);
#else
  return __builtin_popcount(bits);
#endif
}

/// Place of the highest set bit; there is one.
SOFTSCOPE_HD inline int highestBit(std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  return 31 - __clz(static_cast<int>(bits));
#else
  return 31 - __builtin_clz(bits);
#endif
}

/// On the device a third of the time of a root and a division.
SOFTSCOPE_HD inline double inverseRoot(double value) {
#ifdef __CUDA_ARCH__
  return rsqrt(value);
#else
  return 1 / std::sqrt(value);
#endif
}

/// a b + c in one instruction of the device, for loops of sums: elsewhere, compiled so that nothing
/// is contracted, kernels round as the CPU does.
SOFTSCOPE_HD inline double multiplyAdd(double a, double b, double c) {
#ifdef __CUDA_ARCH__
  return fma(a, b, c);
#else
  return a * b + c;
#endif
}

SOFTSCOPE_HD inline float bitsAsFloat(std::uint32_t bits) {
#ifdef __CUDA_ARCH__
  return __uint_as_float(bits);
#else
  float value;
  __builtin_memcpy(&value, &bits, sizeof value);
  return value;
#endif
}
SOFTSCOPE_HD inline std::uint32_t floatAsBits(float value) {
#ifdef __CUDA_ARCH__
  return __float_as_uint(value);
#else
  std::uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  return bits;
#endif
}
SOFTSCOPE_HD inline float quietNan() { return bitsAsFloat(0x7FC00000u); }

/// One call of `body(u, v, z)` a pixel, lanes of a warp side by side.
template <class Body>
struct PixelKernel {
  static constexpr int kThreads = 256, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  Body body;
  int width, height;

  Grid grid(int depth = 1) const { return {blocksFor(width, 32), blocksFor(height, 8), depth}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int u = at.x * 32 + at.thread % 32, v = at.y * 8 + at.thread / 32;
    if (u < width && v < height) body(u, v, at.z);
  }
};

}  // namespace softscope::cuda
