#include "fusion/frame_comparer.h"

#include "core/parallel.h"
#include "fusion/drawn_points.h"

namespace softscope {

std::vector<std::int32_t> CpuFrameComparer::visiblePoints(const PointModel& model,
                                                          const Observation& observation,
                                                          const Raster<PixelState>& states,
                                                          const VisibilityOptions& options) {
  return findVisible(model, observation, states, options).seen();
}

FrameComparison CpuFrameComparer::compare(const PointModel& model, const WarpGraph& graph,
                                          const Observation& observation,
                                          const Raster<PixelState>& states,
                                          const FusionOptions& options) {
  FrameComparison found;
  const auto draw = [&] {
    const DrawnPoints drawn(model, posedCamera(observation.left, observation.world_from_left));
    parallelInvoke([&] { found.predicted = backProjectionError(drawn, observation, states); },
                   [&] { found.view = viewEvidence(drawn, observation, states, options.pixels); });
  };
  // Independent.
  parallelInvoke(draw,
                 [&] { found.model = compareModel(model, graph, observation, states, options); });
  return found;
}

BackProjectionError CpuFrameComparer::error(const PointModel& model, const Observation& observation,
                                            const Raster<PixelState>& states) {
  return backProjectionError(model, observation, states);
}

}  // namespace softscope
