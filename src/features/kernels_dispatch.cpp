// src/features/kernels_dispatch.cpp: choice of the instruction set.
#include "features/kernels.h"

namespace softscope {

extern const FeatureKernels featureKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const FeatureKernels featureKernels_avx2;
#endif

FeatureKernelList allFeatureKernels() {
  FeatureKernelList list{{&featureKernels_baseline}, 1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) list.sets[list.count++] = &featureKernels_avx2;
#endif
  return list;
}

const FeatureKernels& featureKernels() {
  const FeatureKernelList list = allFeatureKernels();
  return *list.sets[list.count - 1];
}

}  // namespace softscope
