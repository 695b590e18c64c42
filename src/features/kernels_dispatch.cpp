// src/features/kernels_dispatch.cpp: choice of the instruction set.
#include "features/kernels.h"

namespace softscope {

extern const FeatureKernels featureKernels_baseline, featureKernels_avx2;

KernelList<FeatureKernels> allFeatureKernels() { return SOFTSCOPE_KERNELS(featureKernels); }

const FeatureKernels& featureKernels() { return allFeatureKernels().fastest(); }

}  // namespace softscope
