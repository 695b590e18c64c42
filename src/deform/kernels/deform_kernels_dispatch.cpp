// src/deform/kernels/deform_kernels_dispatch.cpp: choice of the instruction set.
#include "deform/kernels/deform_kernels.h"

namespace softscope {

extern const DeformKernels deformKernels_baseline, deformKernels_avx2;

KernelList<DeformKernels> allDeformKernels() { return SOFTSCOPE_KERNELS(deformKernels); }

const DeformKernels& deformKernels() { return allDeformKernels().fastest(); }

}  // namespace softscope
