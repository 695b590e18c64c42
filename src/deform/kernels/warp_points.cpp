// src/deform/kernels/warp_points.cpp: points and normals carried by nodes: docs/energy.md (2),
// (24). Compiled once a set, never contracted, so that all sets and the GPU give the same bytes.
#include "deform/kernels/warp_points.h"

#include <cstring>

#include "deform/kernels/warp_formulas.h"

namespace softscope {
namespace {

using Float4 = float __attribute__((vector_size(16)));

/// From any address, by one instruction.
inline Float4 loadFloat4(const float* p) {
  Float4 x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
inline Float4 splatFloat(float x) { return Float4{x, x, x, x}; }

inline Blend<Float4> blendNodes(const PackedNode* nodes, const std::int32_t* ids,
                                const float* weights) {
  Blend<Float4> blend = {};
  for (int k = 0; k < 4; ++k) {
    const float* values = nodes[ids[k]].values;
    const Float4 weight = splatFloat(weights[k]);
    for (int c = 0; c < 4; ++c) blend.columns[c] += weight * loadFloat4(values + 4 * c);
  }
  return blend;
}

}  // namespace

void SOFTSCOPE_NAME(warpPoints,
                    SOFTSCOPE_SIMD_SET)(const PackedNode* nodes, const std::int32_t* stencils,
                                        const void* bindings, int binding_stride,
                                        const float* positions, const float* normals, int count,
                                        float* out_positions, float* out_normals) {
  const char* binding = static_cast<const char*>(bindings);
  for (int i = 0; i < count; ++i, binding += binding_stride) {
    const std::int32_t stencil = *reinterpret_cast<const std::int32_t*>(binding);
    const float* weights = reinterpret_cast<const float*>(binding + sizeof(std::int32_t));
    if (stencil < 0) {
      for (int c = 0; c < 3; ++c) {
        out_positions[3 * i + c] = positions[3 * i + c];
        out_normals[3 * i + c] = normals[3 * i + c];
      }
      continue;
    }
    const Blend<Float4> blend = blendNodes(nodes, stencils + 4 * stencil, weights);
    const float* in = positions + 3 * i;
    warpPosition(blend, splatFloat(in[0]), splatFloat(in[1]), splatFloat(in[2]), in,
                 out_positions + 3 * i);
    warpNormal(blend, normals + 3 * i, out_normals + 3 * i,
               [](float x) { return __builtin_sqrtf(x); });
  }
}

}  // namespace softscope
