// src/stereo/kernels/kernel_sets.h: instruction sets that this processor supports.
#pragma once

#include "stereo/kernels/matching_kernels.h"
#include "stereo/kernels/normal_kernels.h"
#include "stereo/kernels/refinement_kernels.h"
#include "stereo/kernels/smoothing_kernels.h"

namespace softscope {

struct KernelSet {
  const char* name;  // "baseline", "avx2"
  const MatchingKernels* matching;
  const RefinementKernels* refinement;
  const NormalKernels* normal;
  const SmoothingKernels* smoothing;
};

/// Every set that this processor runs, slowest first.
struct KernelSetList {
  KernelSet sets[2];
  int count;
};
KernelSetList allKernelSets();

/// Of the fastest set.
const MatchingKernels& matchingKernels();
const RefinementKernels& refinementKernels();
const NormalKernels& normalKernels();
const SmoothingKernels& smoothingKernels();

}  // namespace softscope
