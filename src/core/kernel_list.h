// src/core/kernel_list.h: inner loops that are compiled once per instruction set, by
// softscope_kernels() of cmake/SoftscopeTargets.cmake, and the choice among the sets at run time.
#pragma once

/// Name of a kernel table of one set, and the name of the set.
#define SOFTSCOPE_NAME_(name, set) name##_##set
#define SOFTSCOPE_NAME(name, set) SOFTSCOPE_NAME_(name, set)
#define SOFTSCOPE_TEXT_(set) #set
#define SOFTSCOPE_TEXT(set) SOFTSCOPE_TEXT_(set)

/// KernelList of the tables `name`_baseline and, where it is compiled, `name`_avx2.
#ifdef SOFTSCOPE_HAS_AVX2
#define SOFTSCOPE_KERNELS(name) \
  softscope::supportedKernels(&SOFTSCOPE_NAME(name, baseline), &SOFTSCOPE_NAME(name, avx2))
#else
#define SOFTSCOPE_KERNELS(name) softscope::supportedKernels(&SOFTSCOPE_NAME(name, baseline))
#endif

namespace softscope {

/// Sets that this processor supports, slowest first.
template <class Kernels>
struct KernelList {
  const Kernels* sets[2];
  int count;

  const Kernels& fastest() const { return *sets[count - 1]; }
};

template <class Kernels>
KernelList<Kernels> supportedKernels(const Kernels* baseline) {
  return {{baseline}, 1};
}

#ifdef SOFTSCOPE_HAS_AVX2
template <class Kernels>
KernelList<Kernels> supportedKernels(const Kernels* baseline, const Kernels* avx2) {
  const bool supported = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return {{baseline, avx2}, supported ? 2 : 1};
}
#endif

}  // namespace softscope
