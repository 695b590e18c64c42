// cuda/warp/warp_lanes.h: the blended displacement of a point by its nodes.
#pragma once

#include <cmath>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/kernels/deform_kernels.h"
#include "deform/kernels/warp_formulas.h"

namespace softscope::cuda {

/// Four floats, interface of warp_formulas.h.
struct Lanes {
  float values[4];
  SOFTSCOPE_HD float operator[](int i) const { return values[i]; }
  SOFTSCOPE_HD friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {{a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}};
  }
  SOFTSCOPE_HD friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {{a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]}};
  }
};
SOFTSCOPE_HD inline Lanes lanesOf(float x) { return {{x, x, x, x}}; }

/// Of a bound point.
SOFTSCOPE_HD inline Blend<Lanes> blendOf(const PackedNode* packed, const NodeStencil& nodes,
                                         const PointBinding& binding) {
  Blend<Lanes> blend = {};
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const float* values = packed[nodes[k]].values;
    for (int c = 0; c < 4; ++c)
      blend.columns[c] = blend.columns[c] + lanesOf(binding.weights[k]) *
                                                Lanes{{values[4 * c], values[4 * c + 1],
                                                       values[4 * c + 2], values[4 * c + 3]}};
  }
  return blend;
}

SOFTSCOPE_HD inline void warpBy(const Blend<Lanes>& blend, const Eigen::Vector3f& point_mm,
                                const Eigen::Vector3f& normal, Eigen::Vector3f* warped_mm,
                                Eigen::Vector3f* warped_normal) {
  const float* in = point_mm.data();
  warpPosition(blend, lanesOf(in[0]), lanesOf(in[1]), lanesOf(in[2]), in, warped_mm->data());
  warpNormal(blend, normal.data(), warped_normal->data(), [](float x) { return std::sqrt(x); });
}

}  // namespace softscope::cuda
