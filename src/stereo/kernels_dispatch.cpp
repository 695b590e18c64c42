// src/stereo/kernels_dispatch.cpp: which instruction sets this processor runs.
#include "stereo/kernels.h"

namespace softscope {

extern const StereoKernels stereoKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const StereoKernels stereoKernels_avx2;
#endif

StereoKernelList allStereoKernels() {
  StereoKernelList list{{&stereoKernels_baseline}, 1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) list.sets[list.count++] = &stereoKernels_avx2;
#endif
  return list;
}

const StereoKernels& stereoKernels() {
  const StereoKernelList list = allStereoKernels();
  return *list.sets[list.count - 1];
}

}  // namespace softscope
