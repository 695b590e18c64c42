// cuda/fusion/fusion_points.h: kernel body that averages the model's points with a frame.
#pragma once

#include "cuda/fusion/fusion_layout.h"
#include "fusion/fusing_formulas.h"

namespace softscope::cuda {

/// A thread per point: averaged, or contradicted, and drawn as it is then.
struct FuseKernel {
  static constexpr int kThreads = 128, kPhases = 3;
  struct Shared {
    int seen, fused, contradicted;
  };
  using Local = Nothing;
  FusingFrame frame;
  ModelArrays model;
  int count;
  const PointSight* sights;
  FusionGraphLayout graph;
  AnchoredBlocks anchored;
  std::uint32_t* nearest;  // bits of the model's nearest depth in every pixel
  FusionCounts* counts;

  Grid blocks() const { return {blocksFor(count, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared& shared, Local&) const {
    if constexpr (kPhase == 0) {
      if (at.thread == 0) shared = {0, 0, 0};
    } else if constexpr (kPhase == 1) {
      const int i = at.x * kThreads + at.thread;
      if (i >= count) return;
      const PointSight sight = sights[i];
      ModelPoint point = model.at(i);
      if (update(i, sight, &point, &shared)) model.set(i, point);
      draw(sight, point);
    } else {
      if (at.thread > 0) return;
      atomicPlus(&counts->seen, shared.seen);
      atomicPlus(&counts->fused, shared.fused);
      atomicPlus(&counts->contradicted, shared.contradicted);
    }
  }

 private:
  /// Whether the point may have changed.
  SOFTSCOPE_HD bool update(int i, const PointSight& sight, ModelPoint* point,
                           Shared* shared) const {
    if (sight.sight == Sight::kSeen) atomicPlus(&shared->seen, 1);
    if (isContradicted(sight, point->weight, frame.limits)) {
      point->weight =
          weightAfterContradiction(point->weight, innovationOf(i).excess_mm2, sight.pixel, frame);
      atomicPlus(&shared->contradicted, 1);
      return true;
    }
    if (sight.sight != Sight::kSeen) return false;
    if (fusePoint(sight, surroundingsOf(i, sight.pixel, *point), frame, point))
      atomicPlus(&shared->fused, 1);
    return true;
  }
  SOFTSCOPE_HD Innovation innovationOf(int i) const {
    const PointBinding& binding = model.bindings[i];
    if (!graph.has_innovation || !isCarried(binding, graph.stencil_count)) return {};
    return innovationAt(graph.stencils[binding.stencil], binding, graph.innovation);
  }
  SOFTSCOPE_HD FusingSurroundings surroundingsOf(int i, int pixel, const ModelPoint& point) const {
    const PointBinding& binding = model.bindings[i];
    FusingSurroundings around;
    around.innovation = innovationOf(i);
    around.anchored = anchored.at(pixel);
    if (frame.limits.node_trust != NodeTrust::kEqual && isCarried(binding, graph.stencil_count))
      around.node_mm =
          nearestNodeMm(graph.stencils[binding.stencil], graph.nodes_mm, point.position_mm);
    return around;
  }
  SOFTSCOPE_HD void draw(const PointSight& sight, const ModelPoint& point) const {
    if (sight.pixel < 0 || !(point.weight > 0)) return;
    const float depth_mm = frame.camera.toLeft(point.position_mm).z();
    atomicLeast(&nearest[sight.pixel], floatAsBits(depth_mm));
  }
};

}  // namespace softscope::cuda
