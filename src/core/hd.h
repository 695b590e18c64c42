// src/core/hd.h: macros of formulas for both CPU and GPU.
#pragma once

#ifdef __CUDACC__
#define SOFTSCOPE_HD __host__ __device__
/// Formula over any scalar or SIMD vector. Always inlined, so that
/// code of one instruction set stays inside its own object file.
#define SOFTSCOPE_FORMULA __host__ __device__ __forceinline__
#else
#define SOFTSCOPE_HD
#define SOFTSCOPE_FORMULA inline __attribute__((always_inline))
#endif
