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
  int seen = 0;  // points that the camera sees
  PointFusionSummary points;
  InsertionSummary insertion;
  IndexMap index_map;  // from the model with new points at its end to the model as it is now
};

/// Brings the warped model (world frame) up to the observation; `states` are its pixels', judged by
/// `options.pixels`. `graph` has live positions. What
/// must outlast a frame is in `memory`; a run that is resumed needs it back.
/// Throws OptionError for bad options and for arguments that don't fit together; the model and the
/// memory are then as they were.
ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               InsertionMemory* memory, PointModel* model);
/// The same, where compareModel() was called with these.
ModelUpdateSummary updateModel(const Observation& observation, const Raster<PixelState>& states,
                               const WarpGraph& graph, const FusionOptions& options,
                               const ModelComparison& comparison, InsertionMemory* memory,
                               PointModel* model);

}  // namespace softscope
