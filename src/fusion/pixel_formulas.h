// src/fusion/pixel_formulas.h: state of one pixel of a frame, for the CPU and the GPU.
#pragma once

#include <Eigen/Core>

#include "core/hd.h"
#include "fusion/frame_rasters.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/posed_camera.h"

namespace softscope {

/// Nearest and farthest depth around a pixel, mm.
struct DepthSpan {
  float nearest_mm = 0, farthest_mm = 0;
};

/// Whether a neighbouring depth differs by more than the step of an edge.
SOFTSCOPE_HD inline bool isBesideEdge(float depth_mm, const DepthSpan& around) {
  const float step_mm = static_cast<float>(PixelOptions::kEdgeStep) * depth_mm;
  return !(around.farthest_mm - depth_mm <= step_mm && depth_mm - around.nearest_mm <= step_mm);
}

/// Whether sigma of the depth and normal of pixel (u, v) are acceptable.
SOFTSCOPE_HD inline bool isAcceptedDepth(int u, int v, const FrameRasters& rasters,
                                         const PosedCamera& camera, float max_sigma_mm) {
  const int pixel = v * camera.width_px + u;
  if (rasters.sigma_mm != nullptr) {
    const float sigma_mm = rasters.sigma_mm[pixel];
    if (!(sigma_mm > 0 && sigma_mm <= max_sigma_mm)) return false;
  }
  const Eigen::Vector3f ray = camera.ray(u, v);
  const float towards = -rasters.normals[pixel].dot(ray);  // NaN without a normal
  return towards >= static_cast<float>(PixelOptions::kMinCosine) * ray.norm();
}

/// docs/fusion.md, "Pixel selection". `around`: within PixelOptions::kEdgeRadiusPx.
SOFTSCOPE_HD inline PixelState pixelState(int u, int v, bool is_masked, const DepthSpan& around,
                                          const FrameRasters& rasters, const PosedCamera& camera,
                                          float max_sigma_mm) {
  if (is_masked) return PixelState::kMasked;
  const float depth_mm = rasters.depth_mm[v * camera.width_px + u];
  if (!(depth_mm > 0 && depth_mm < static_cast<float>(PixelOptions::kMaxDepthMm)))
    return PixelState::kUnmeasured;
  if (isBesideEdge(depth_mm, around)) return PixelState::kEdge;
  return isAcceptedDepth(u, v, rasters, camera, max_sigma_mm) ? PixelState::kAccepted
                                                              : PixelState::kRejected;
}

}  // namespace softscope
