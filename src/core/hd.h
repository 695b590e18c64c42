// src/core/hd.h: marks the formulas that both the CPU and the GPU compile.
#pragma once

#ifdef __CUDACC__
#define SOFTSCOPE_HD __host__ __device__
#else
#define SOFTSCOPE_HD
#endif
