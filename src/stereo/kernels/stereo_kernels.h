// src/stereo/kernels/stereo_kernels.h: the inner loops of stereo, compiled once for each
// instruction set.
#pragma once

#include "core/kernel_list.h"
#include "stereo/kernels/matching_kernels.h"
#include "stereo/kernels/normal_kernels.h"
#include "stereo/kernels/refinement_kernels.h"
#include "stereo/kernels/resampling_kernels.h"
#include "stereo/kernels/smoothing_kernels.h"

namespace softscope {

struct StereoKernels {
  const char* name;  // "baseline", "avx2"
  const MatchingKernels* matching;
  const RefinementKernels* refinement;
  const NormalKernels* normal;
  const SmoothingKernels* smoothing;
  const ResamplingKernels* resampling;
};

/// Sets that this processor supports, slowest first.
KernelList<StereoKernels> allStereoKernels();

/// Of the fastest set.
const MatchingKernels& matchingKernels();
const RefinementKernels& refinementKernels();
const NormalKernels& normalKernels();
const SmoothingKernels& smoothingKernels();
const ResamplingKernels& resamplingKernels();

}  // namespace softscope
