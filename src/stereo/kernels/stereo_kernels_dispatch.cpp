// src/stereo/kernels/stereo_kernels_dispatch.cpp: choice of the instruction set at run time.
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {

extern const StereoKernels stereoKernels_baseline, stereoKernels_avx2;

KernelList<StereoKernels> allStereoKernels() { return SOFTSCOPE_KERNELS(stereoKernels); }

const MatchingKernels& matchingKernels() { return *allStereoKernels().fastest().matching; }
const RefinementKernels& refinementKernels() { return *allStereoKernels().fastest().refinement; }
const NormalKernels& normalKernels() { return *allStereoKernels().fastest().normal; }
const SmoothingKernels& smoothingKernels() { return *allStereoKernels().fastest().smoothing; }
const ResamplingKernels& resamplingKernels() { return *allStereoKernels().fastest().resampling; }

}  // namespace softscope
