// src/stereo/kernels/stereo_kernels.cpp: SOFTSCOPE_SIMD_SET names the instruction set.
#include "stereo/kernels/stereo_kernels.h"

namespace softscope {

extern const MatchingKernels SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET);
extern const RefinementKernels SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET);
extern const NormalKernels SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET);
extern const SmoothingKernels SOFTSCOPE_NAME(smoothingKernels, SOFTSCOPE_SIMD_SET);
extern const ResamplingKernels SOFTSCOPE_NAME(resamplingKernels, SOFTSCOPE_SIMD_SET);

extern const StereoKernels SOFTSCOPE_NAME(stereoKernels, SOFTSCOPE_SIMD_SET);
const StereoKernels SOFTSCOPE_NAME(stereoKernels, SOFTSCOPE_SIMD_SET) = {
    SOFTSCOPE_TEXT(SOFTSCOPE_SIMD_SET),
    &SOFTSCOPE_NAME(matchingKernels, SOFTSCOPE_SIMD_SET),
    &SOFTSCOPE_NAME(refinementKernels, SOFTSCOPE_SIMD_SET),
    &SOFTSCOPE_NAME(normalKernels, SOFTSCOPE_SIMD_SET),
    &SOFTSCOPE_NAME(smoothingKernels, SOFTSCOPE_SIMD_SET),
    &SOFTSCOPE_NAME(resamplingKernels, SOFTSCOPE_SIMD_SET)};

}  // namespace softscope
