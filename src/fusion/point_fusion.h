// src/fusion/point_fusion.h: weighted averaging of visible points with their measurements.
#pragma once

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/anchor_agreement.h"
#include "fusion/colour_gain.h"
#include "fusion/fusion_options.h"
#include "fusion/innovation.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// Comparison of a frame with the model, before any point changes.
struct ModelComparison {
  Visibility visibility;
  ColourGain gain;
  InnovationField innovation;
  AnchorAgreement anchored;
};

/// `graph` has live positions, `states` are classifyPixels() of the observation.
/// Throws OptionError for invalid options and inconsistent arguments.
ModelComparison compareModel(const PointModel& model, const WarpGraph& graph,
                             const Observation& observation, const Raster<PixelState>& states,
                             const FusionOptions& options);

/// Counts of the update.
struct PointFusionSummary {
  int fused = 0;         // averaged with a measurement
  int contradicted = 0;  // free-space violation, or not confirmed: lost weight
  ColourGain gain;       // of the image against the model
};

/// Averages every visible point with its measurement, reduces the weight of
/// contradicted points: docs/fusion.md (F5) to (F13) and (F21) to (F24). The next
/// keepDensity() removes points of weight 0. `graph` gives the distance of points
/// to their nodes (live positions); points without nodes count as at distance 0.
/// Throws OptionError for invalid options and inconsistent arguments.
PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const ModelComparison& comparison, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model);
/// Computes the comparison first, except the visibility.
PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const Visibility& visibility, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model);

}  // namespace softscope
