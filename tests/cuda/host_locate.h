// tests/cuda/host_locate.h: the kernels of view, matching and lift, run by the host executor.
#pragma once

#include <cstring>

#include "cuda/device/host_executor.h"
#include "cuda/locate/locate.h"
#include "cuda/locate/locate_passes.h"
#include "host_memory.h"

namespace softscope::test {

/// What cuda::Locator finds; `seen_gray` as there.
inline cuda::LocatedMatches locateOnTheHost(const PinholeCamera& camera,
                                            const ModelViewOptions& view,
                                            const MatcherOptions& matcher, const PointModel& model,
                                            const Eigen::Isometry3d& world_from_left,
                                            const GrayImage& seen_gray, const MatchPicture& live,
                                            const DepthMap& depth, unsigned seed) {
  const int points = static_cast<int>(model.size());
  cuda::Arena counting;
  cuda::LocateLayout(counting, matcher, camera.width_px, camera.height_px, points);
  HostMemory memory(counting.bytes());
  cuda::Arena arena(memory.data());
  const cuda::LocateLayout layout(arena, matcher, camera.width_px, camera.height_px, points);
  const auto copy = [](void* to, const auto& from) {
    if (!from.empty())
      std::memcpy(to, static_cast<const void*>(from.data()), from.size() * sizeof from[0]);
  };
  copy(layout.view.positions_mm, model.positions_mm);
  copy(layout.view.normals, model.normals);
  copy(layout.view.colours, model.colours);
  copy(layout.view.anchors, model.anchors);
  *layout.view.point_count = points;
  *layout.view.camera = viewProjector(camera, world_from_left, view);
  const cuda::MatchScale& full = layout.match.levels.front();
  copy(full.gray[1].data, live.gray.values);
  copy(layout.match.mask[1].data, live.ignore.values);
  copy(full.gray[0].data, seen_gray.values);
  copy(layout.live_depth.data, depth.depth_mm.values);
  copy(layout.live_sigma.data, depth.sigma_mm.values);
  *layout.inputs = {camera, rigidRows(world_from_left)};
  *layout.match.inputs = {seen_gray.empty() ? 1 : 0, {1, live.ignore.empty() ? 0 : 1}};
  cuda::HostExecutor executor(seed);
  cuda::LocatePasses<cuda::HostExecutor>(executor, layout).locate(view, !seen_gray.empty());
  return {cuda::pixelMatches(layout.match.list, *layout.match.match_count),
          cuda::liftedMatches(layout.list, *layout.lifted_count)};
}

}  // namespace softscope::test
