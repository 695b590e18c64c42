// cuda/fusion/fusion_insertion.h: kernel bodies that find what the model does not explain, and make
// points of it.
#pragma once

#include <limits>

#include "cuda/fusion/fusion_cells.h"
#include "cuda/fusion/fusion_layout.h"
#include "fusion/insertion_formulas.h"

namespace softscope::cuda {

/// After FuseKernel: depths that the model does not explain. Those that may become points take a
/// cell, which keeps the first of its pixels.
struct UnexplainedBody {
  FusingFrame frame;
  InsertionLimits limits;
  LastUnexplained last;
  bool at_once;
  const PixelState* states;
  FusionFrameLayout image;
  float* unexplained_mm;
  CellSlots cells;
  std::uint32_t* first_pixels;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const PosedCamera& camera = frame.camera;
    const int pixel = v * camera.width_px + u;
    unexplained_mm[pixel] = quietNan();
    image.slots[pixel] = -1;
    const float depth_mm = frame.rasters.depth_mm[pixel];
    if (!mayMakePoint(states[pixel], depth_mm, frame.rasters.sigma_mm, pixel, limits)) return;
    // Most pixels are explained by the point that they show.
    if (isExplained(bitsAsFloat(image.nearest[pixel]), depth_mm, limits.band_mm)) return;
    const int reach = footprintPx(depth_mm, camera.fx_px, limits.spacing_mm);
    if (isExplained(nearestWithin(u, v, reach), depth_mm, limits.band_mm)) return;
    unexplained_mm[pixel] = depth_mm;
    if (!(depth_mm > 0)) return;
    atomicPlus(&image.counts->unexplained_px, 1);
    const Eigen::Vector3f ray = camera.ray(u, v);
    if (!at_once && !isConfirmed(camera.toWorld(ray * depth_mm), last, limits.band_mm)) return;
    const CellKey key = insertionCell(ray, depth_mm, camera.fx_px, limits);
    if (key == kNoCell) return;
    const std::int32_t slot = cells.take(key);
    image.slots[pixel] = slot;
    atomicLeast(&first_pixels[slot], static_cast<std::uint32_t>(pixel));
  }

 private:
  SOFTSCOPE_HD float nearestWithin(int u0, int v0, int reach) const {
    const int width = frame.camera.width_px, height = frame.camera.height_px;
    float least_mm = std::numeric_limits<float>::infinity();
    for (int v = v0 - reach; v <= v0 + reach; ++v)
      for (int u = u0 - reach; u <= u0 + reach; ++u) {
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const float depth_mm = bitsAsFloat(image.nearest[v * width + u]);
        if (depth_mm < least_mm) least_mm = depth_mm;
      }
    return least_mm;
  }
};

/// For putInOrder(), after UnexplainedBody: the first pixel of every cell becomes a point at the
/// model's end.
struct NewPoints {
  FusingFrame frame;
  const std::int32_t* slots;
  const std::uint32_t* first_pixels;
  ModelArrays model;
  int model_count, pixels;

  int capacity() const { return pixels; }
  SOFTSCOPE_HD int count() const { return pixels; }
  SOFTSCOPE_HD bool chosen(int pixel) const {
    return slots[pixel] >= 0 && first_pixels[slots[pixel]] == static_cast<std::uint32_t>(pixel);
  }
  SOFTSCOPE_HD void put(int pixel, int place) const {
    model.set(model_count + place, newPoint(pixel, frame));
    model.bindings[model_count + place] = PointBinding();
  }
};

}  // namespace softscope::cuda
