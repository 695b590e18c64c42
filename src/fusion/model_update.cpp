#include "fusion/model_update.h"

namespace softscope {

ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               InsertionMemory* memory, PointModel* model) {
  return updateModel(observation, states, graph, options,
                     compareModel(*model, graph, observation, states, options), memory, model);
}

ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               const ModelComparison& comparison, InsertionMemory* memory,
                               PointModel* model) {
  options.validate();
  const Visibility& visibility = comparison.visibility;
  ModelUpdateSummary summary;
  for (const PointSight& point : visibility.points) summary.seen += point.sight == Sight::kSeen;
  summary.points =
      fusePoints(graph, observation, comparison, options.points, options.colour, model);
  summary.insertion =
      insertPoints(observation, states, visibility, summary.points.gain, options, memory, model);
  summary.index_map = keepDensity(
      options.density, posedCamera(observation.left, observation.world_from_left), model);
  return summary;
}

}  // namespace softscope
