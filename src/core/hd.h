// src/core/hd.h: marks the formulas that both the CPU and the GPU compile.
#pragma once

#ifdef __CUDACC__
#define SOFTSCOPE_HD __host__ __device__
/// A formula over any scalar or SIMD vector. Always inlined, so that no instruction set leaks out
/// of its own object file.
#define SOFTSCOPE_FORMULA __host__ __device__ __forceinline__
#else
#define SOFTSCOPE_HD
#define SOFTSCOPE_FORMULA inline __attribute__((always_inline))
#endif
