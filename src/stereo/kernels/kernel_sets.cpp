#include "stereo/kernels/kernel_sets.h"

namespace softscope {

extern const MatchingKernels matchingKernels_baseline;
extern const RefinementKernels refinementKernels_baseline;
extern const NormalKernels normalKernels_baseline;
extern const SmoothingKernels smoothingKernels_baseline;
#ifdef SOFTSCOPE_HAS_AVX2
extern const MatchingKernels matchingKernels_avx2;
extern const RefinementKernels refinementKernels_avx2;
extern const NormalKernels normalKernels_avx2;
extern const SmoothingKernels smoothingKernels_avx2;
#endif

KernelSetList allKernelSets() {
  KernelSetList list{{{"baseline", &matchingKernels_baseline, &refinementKernels_baseline,
                       &normalKernels_baseline, &smoothingKernels_baseline}},
                     1};
#ifdef SOFTSCOPE_HAS_AVX2
  if (__builtin_cpu_supports("avx2"))
    list.sets[list.count++] = {"avx2", &matchingKernels_avx2, &refinementKernels_avx2,
                               &normalKernels_avx2, &smoothingKernels_avx2};
#endif
  return list;
}

const MatchingKernels& matchingKernels() {
  const KernelSetList list = allKernelSets();
  return *list.sets[list.count - 1].matching;
}

const RefinementKernels& refinementKernels() {
  const KernelSetList list = allKernelSets();
  return *list.sets[list.count - 1].refinement;
}

const NormalKernels& normalKernels() {
  const KernelSetList list = allKernelSets();
  return *list.sets[list.count - 1].normal;
}

const SmoothingKernels& smoothingKernels() {
  const KernelSetList list = allKernelSets();
  return *list.sets[list.count - 1].smoothing;
}

}  // namespace softscope
