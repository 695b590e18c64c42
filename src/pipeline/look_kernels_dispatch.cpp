// src/pipeline/look_kernels_dispatch.cpp: choice of the instruction set.
#include "pipeline/look_kernels.h"

namespace softscope {

extern const LookKernels lookKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const LookKernels lookKernels_avx2;
#endif

LookKernelList allLookKernels() {
  LookKernelList list{{&lookKernels_baseline}, 1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) list.sets[list.count++] = &lookKernels_avx2;
#endif
  return list;
}

const LookKernels& lookKernels() {
  const LookKernelList list = allLookKernels();
  return *list.sets[list.count - 1];
}

}  // namespace softscope
