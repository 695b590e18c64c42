// tests/cuda/fusion_kernels.h: kernel bodies that call every formula of fusing, insertion and
// density.
#pragma once

#include <limits>

#include "cuda/device/kernel.h"
#include "fusion/density_formulas.h"
#include "fusion/fusing_formulas.h"
#include "fusion/insertion_formulas.h"
#include "fusion/pixel_formulas.h"

namespace softscope::test {

/// The model with what the comparison says of it, and the nodes that carry it; owns nothing.
struct FusionPoints {
  int count = 0;
  ModelPoint* points = nullptr;
  const PointBinding* bindings = nullptr;
  const PointSight* sights = nullptr;
  const NodeStencil* stencils = nullptr;
  int stencil_count = 0;
  const Eigen::Vector3d* nodes_mm = nullptr;
  const Innovation* innovation = nullptr;  // per node; null: none
  const std::uint8_t* anchored = nullptr;  // per pixel
};

/// States of pixels, by all depths around each.
struct StateBody {
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

/// A thread per point: averaged, or contradicted.
struct FuseKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = cuda::Nothing;
  using Local = cuda::Nothing;
  FusingFrame frame;
  FusionPoints model;

  template <int kPhase>
  SOFTSCOPE_HD void run(const cuda::Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= model.count) return;
    const PointSight& sight = model.sights[i];
    ModelPoint& point = model.points[i];
    if (isContradicted(sight, point.weight, frame.limits))
      point.weight =
          weightAfterContradiction(point.weight, innovationOf(i).excess_mm2, sight.pixel, frame);
    else if (sight.sight == Sight::kSeen)
      fusePoint(sight, surroundingsOf(i), frame, &point);
  }

 private:
  SOFTSCOPE_HD Innovation innovationOf(int i) const {
    const PointBinding& binding = model.bindings[i];
    if (model.innovation == nullptr || !isCarried(binding, model.stencil_count)) return {};
    return innovationAt(model.stencils[binding.stencil], binding, model.innovation);
  }
  SOFTSCOPE_HD FusingSurroundings surroundingsOf(int i) const {
    const PointBinding& binding = model.bindings[i];
    FusingSurroundings around;
    around.innovation = innovationOf(i);
    around.anchored = model.anchored[model.sights[i].pixel] != 0;
    if (frame.limits.node_trust != NodeTrust::kEqual && isCarried(binding, model.stencil_count))
      around.node_mm = nearestNodeMm(model.stencils[binding.stencil], model.nodes_mm,
                                     model.points[i].position_mm);
    return around;
  }
};

/// After FuseKernel, a thread per point: the model's nearest depth in every pixel.
struct DrawKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = cuda::Nothing;
  using Local = cuda::Nothing;
  FusionPoints model;
  PosedCamera camera;
  std::uint32_t* nearest;  // bits of depths

  template <int kPhase>
  SOFTSCOPE_HD void run(const cuda::Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= model.count) return;
    const int pixel = model.sights[i].pixel;
    if (pixel < 0 || !(model.points[i].weight > 0)) return;
    const float depth_mm = camera.toLeft(model.points[i].position_mm).z();
    cuda::atomicLeast(&nearest[pixel], cuda::floatAsBits(depth_mm));
  }
};

/// After DrawKernel: depths that the model does not explain, and the points that they may become.
struct InsertBody {
  FusingFrame frame;
  InsertionLimits limits;
  LastUnexplained last;
  bool at_once;
  const PixelState* states;
  const std::uint32_t* nearest;
  float* unexplained_mm;
  CellKey* cells;  // kNoCell: no new point here
  ModelPoint* points;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    const PosedCamera& camera = frame.camera;
    const int pixel = v * camera.width_px + u;
    unexplained_mm[pixel] = cuda::quietNan();
    cells[pixel] = kNoCell;
    if (!mayMakePoint(states[pixel], frame.rasters.sigma_mm, pixel, limits.max_sigma_mm)) return;
    const float depth_mm = frame.rasters.depth_mm[pixel];
    const int reach = footprintPx(depth_mm, camera.fx_px, limits.spacing_mm);
    if (isExplained(nearestWithin(u, v, reach), depth_mm, limits.band_mm)) return;
    unexplained_mm[pixel] = depth_mm;
    const Eigen::Vector3f ray = camera.ray(u, v);
    if (!at_once && !isConfirmed(camera.toWorld(ray * depth_mm), last, limits.band_mm)) return;
    cells[pixel] = insertionCell(ray, depth_mm, camera.fx_px, limits);
    points[pixel] = newPoint(pixel, frame);
  }

 private:
  SOFTSCOPE_HD float nearestWithin(int u0, int v0, int reach) const {
    const int width = frame.camera.width_px, height = frame.camera.height_px;
    float least_mm = std::numeric_limits<float>::infinity();
    for (int v = v0 - reach; v <= v0 + reach; ++v)
      for (int u = u0 - reach; u <= u0 + reach; ++u) {
        if (u < 0 || v < 0 || u >= width || v >= height) continue;
        const float depth_mm = cuda::bitsAsFloat(nearest[v * width + u]);
        if (depth_mm < least_mm) least_mm = depth_mm;
      }
    return least_mm;
  }
};

/// A thread per point: its cell.
struct DensityCellKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = cuda::Nothing;
  using Local = cuda::Nothing;
  const ModelPoint* points;
  int count;
  PosedCamera camera;
  float cell_mm;
  CellKey* cells;

  template <int kPhase>
  SOFTSCOPE_HD void run(const cuda::Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= count) return;
    const ModelPoint& point = points[i];
    cells[i] = staysInModel(point.normal, point.weight)
                   ? densityCell(point.position_mm, camera, cell_mm)
                   : kNoCell;
  }
};

/// A thread per cell: merges its points, in their order.
struct MergeKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = cuda::Nothing;
  using Local = cuda::Nothing;
  ModelPoint* points;
  const std::int32_t* order;   // points by cell
  const std::int32_t* begins;  // of each cell within `order`, and the end of the last
  int cells;
  float least_cosine;
  std::int32_t* held;   // per place in `order`: those that stay, each cell's first
  std::uint8_t* stays;  // per point

  template <int kPhase>
  SOFTSCOPE_HD void run(const cuda::Place& at, Shared&, Local&) const {
    const int cell = at.x * kThreads + at.thread;
    if (cell >= cells) return;
    std::int32_t* own = held + begins[cell];
    int count = 0;
    for (int k = begins[cell]; k < begins[cell + 1]; ++k) add(order[k], own, &count);
    for (int k = 0; k < count; ++k) stays[own[k]] = 1;
  }

 private:
  SOFTSCOPE_HD void add(std::int32_t i, std::int32_t* own, int* count) const {
    int k = 0;
    while (k < *count && !onSameSide(points[own[k]].normal, points[i].normal, least_cosine)) ++k;
    if (k == *count) {
      own[(*count)++] = i;
    } else if (points[i].weight > points[own[k]].weight) {
      mergeInto(points[own[k]], &points[i]);
      own[k] = i;
    } else {
      mergeInto(points[i], &points[own[k]]);
    }
  }
};

}  // namespace softscope::test
