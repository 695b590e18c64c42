// src/deform/kernels/deform_kernels_dispatch.cpp: choice of the instruction set.
#include "deform/kernels/deform_kernels.h"

namespace softscope {

extern const DeformKernels deformKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const DeformKernels deformKernels_avx2;
#endif

DeformKernelList allDeformKernels() {
  DeformKernelList list{{&deformKernels_baseline}, 1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    list.sets[list.count++] = &deformKernels_avx2;
#endif
  return list;
}

const DeformKernels& deformKernels() {
  static const DeformKernelList list = allDeformKernels();
  return *list.sets[list.count - 1];
}

}  // namespace softscope
