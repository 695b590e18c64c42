// cuda/frame/pixel_state_body.h: kernel body that finds the states of pixels.
#pragma once

#include <limits>

#include "cuda/device/kernel.h"
#include "fusion/pixel_formulas.h"

namespace softscope::cuda {

/// By all depths around each.
struct PixelStateBody {
  FrameRasters rasters;
  PosedCamera camera;
  const std::uint8_t* mask;  // null: none
  float max_sigma_mm;
  PixelState* states;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const int pixel = v * camera.width_px + u;
    const bool is_masked = mask != nullptr && mask[pixel] != 0;
    states[pixel] = pixelState(u, v, is_masked, spanAround(u, v), rasters, camera, max_sigma_mm);
  }

 private:
  SOFTSCOPE_HD DepthSpan spanAround(int u0, int v0) const {
    constexpr int kRadius = PixelOptions::kEdgeRadiusPx;
    constexpr float kFar = std::numeric_limits<float>::infinity();
    DepthSpan span{kFar, -kFar};
    for (int v = v0 - kRadius; v <= v0 + kRadius; ++v)
      for (int u = u0 - kRadius; u <= u0 + kRadius; ++u) {
        if (u < 0 || v < 0 || u >= camera.width_px || v >= camera.height_px) continue;
        const float depth_mm = rasters.depth_mm[v * camera.width_px + u];
        if (depth_mm < span.nearest_mm) span.nearest_mm = depth_mm;
        if (depth_mm > span.farthest_mm) span.farthest_mm = depth_mm;
      }
    return span;
  }
};

}  // namespace softscope::cuda
