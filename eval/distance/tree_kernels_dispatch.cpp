// eval/distance/tree_kernels_dispatch.cpp: choice of the instruction set at run time.
#include "eval/distance/tree_kernels.h"

namespace softscope {

extern const TreeKernels treeKernels_baseline, treeKernels_avx2;

KernelList<TreeKernels> allTreeKernels() { return SOFTSCOPE_KERNELS(treeKernels); }

const TreeKernels& treeKernels() { return allTreeKernels().fastest(); }

}  // namespace softscope
