// src/fusion/model_update.h: stage 7: visibility, averaging, insertion, thinning of points.
#pragma once

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/density_grid.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/point_fusion.h"
#include "fusion/point_insertion.h"

namespace softscope {

struct ModelUpdateSummary {
  int seen = 0;  // number of visible points
  PointFusionSummary points;
  InsertionSummary insertion;
  IndexMap index_map;  // from the model with new points at its end to the final model
};

/// Updates the warped model (world frame) with the observation;
/// `states` are those of its pixels, classified by `options.pixels`.
/// `graph` has live positions. `memory` is kept between frames; a
/// resumed run needs it. Throws OptionError for invalid options and
/// inconsistent arguments; model and memory are then unchanged.
ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               InsertionMemory* memory, PointModel* model);
/// The same, after compareModel() was called with these.
ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               const ModelComparison& comparison, InsertionMemory* memory,
                               PointModel* model);

}  // namespace softscope
