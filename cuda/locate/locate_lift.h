// cuda/locate/locate_lift.h: kernel bodies between view and matching, and from matches to points.
#pragma once

#include "core/image.h"
#include "cuda/device/kernel.h"
#include "cuda/match/match_search.h"
#include "cuda/view/view_draw.h"
#include "features/lift_formulas.h"

namespace softscope::cuda {

/// View for matching: grey, with unseen pixels ignored. With `own_gray`, another
/// image from the same pose is matched instead, and the grey image is unchanged.
struct ViewToMatchBody {
  View<const Rgb8> colour;
  View<const std::uint8_t> view_anchor;
  View<const std::int32_t> point;
  View<std::uint8_t> gray, anchor, mask;
  bool own_gray;

  SOFTSCOPE_HD void operator()(int u, int v, int) const {
    mask.at(u, v) = point.at(u, v) < 0 ? 1 : 0;
    if (own_gray) return;
    gray.at(u, v) = toGray(colour.at(u, v));
    anchor.at(u, v) = view_anchor.at(u, v);
  }
};

/// Plain data of a LiftedMatch.
struct LiftSlot {
  float source_world_mm[3], target_left_mm[3];
  float across_mm, along_mm, similarity;
  std::int32_t model_point, match;
};

/// Inputs of the lift besides the matches.
struct LiftInputs {
  PinholeCamera camera;
  RigidRows world_from_left;
};

/// One thread per match of the list.
struct LiftKernel {
  static constexpr int kThreads = 128, kPhases = 1;
  using Shared = Nothing;
  using Local = Nothing;
  const SlotMatch* list;
  const int* match_count;
  int capacity;
  View<const float> view_depth, live_depth, live_sigma;
  View<const std::int32_t> view_point;
  const LiftInputs* inputs;
  LiftSlot* lifted;
  int* found;  // per match, 0 beyond the list's end

  Grid blocks() const { return {blocksFor(capacity, kThreads), 1, 1}; }
  template <int kPhase>
  SOFTSCOPE_HD void run(const Place& at, Shared&, Local&) const {
    const int i = at.x * kThreads + at.thread;
    if (i >= capacity) return;
    found[i] = i < *match_count && lift(i) ? 1 : 0;
  }

 private:
  SOFTSCOPE_HD static float depthIn(const View<const float>& depth, float u, float v) {
    return depthBetween([&](int x, int y) { return depth.at(x, y); }, depth.width, depth.height, u,
                        v, kLiftStepMm);
  }
  SOFTSCOPE_HD bool lift(int i) const {
    const SlotMatch& match = list[i];
    const float model_mm = depthIn(view_depth, match.model_u, match.model_v);
    const float live_mm = depthIn(live_depth, match.live_u, match.live_v);
    if (!(model_mm > 0 && live_mm > 0)) return false;
    LiftSlot out;
    out.model_point = view_point.at(nearestPixel(match.model_u), nearestPixel(match.model_v));
    if (out.model_point < 0) return false;
    float seen[3];
    liftTo(match.model_u, match.model_v, model_mm, seen);
    inputs->world_from_left.move(seen, out.source_world_mm);
    liftTo(match.live_u, match.live_v, live_mm, out.target_left_mm);
    const int u = nearestPixel(match.live_u), v = nearestPixel(match.live_v);
    out.across_mm = acrossMm(match.sigma_px, live_mm, inputs->camera);
    out.along_mm = live_sigma.contains(u, v) ? live_sigma.at(u, v) : quietNan();
    out.similarity = match.similarity;
    out.match = i;
    lifted[i] = out;
    return true;
  }
  SOFTSCOPE_HD void liftTo(float u, float v, float depth_mm, float (&to)[3]) const {
    const Eigen::Matrix<float, 3, 1> point = liftPixel(inputs->camera, u, v, depth_mm);
    for (int k = 0; k < 3; ++k) to[k] = point(k);
  }
};
/// Compacts the list.
struct KeepLiftedBody {
  const LiftSlot* lifted;
  const int *found, *starts;
  LiftSlot* list;
  SOFTSCOPE_HD void operator()(int i) const {
    if (found[i] != 0) list[starts[i]] = lifted[i];
  }
};

}  // namespace softscope::cuda
