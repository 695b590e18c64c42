// src/features/look_kernels_dispatch.cpp: choice of the instruction set.
#include "features/look_kernels.h"

namespace softscope {

extern const LookKernels lookKernels_baseline, lookKernels_avx2;

KernelList<LookKernels> allLookKernels() { return SOFTSCOPE_KERNELS(lookKernels); }

const LookKernels& lookKernels() { return allLookKernels().fastest(); }

}  // namespace softscope
