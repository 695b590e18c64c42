// eval/distance/tree_kernels_dispatch.cpp: choice of the instruction set at run time.
#include "eval/distance/tree_kernels.h"

namespace softscope {

extern const TreeKernels treeKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const TreeKernels treeKernels_avx2;
#endif

TreeKernelList allTreeKernels() {
  TreeKernelList list{{&treeKernels_baseline}, 1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2")) list.sets[list.count++] = &treeKernels_avx2;
#endif
  return list;
}

const TreeKernels& treeKernels() {
  const TreeKernelList list = allTreeKernels();
  return *list.sets[list.count - 1];
}

}  // namespace softscope
