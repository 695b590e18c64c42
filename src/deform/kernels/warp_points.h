// src/deform/kernels/warp_points.h: the warp of points of one set of instructions.
#pragma once

#include "deform/kernels/deform_kernels.h"

namespace softscope {

/// DeformKernels::warpPoints.
void SOFTSCOPE_NAME(warpPoints,
                    SOFTSCOPE_SIMD_SET)(const PackedNode* nodes, const std::int32_t* stencils,
                                        const void* bindings, int binding_stride,
                                        const float* positions, const float* normals, int count,
                                        float* out_positions, float* out_normals);

}  // namespace softscope
