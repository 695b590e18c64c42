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

/// `graph` has live positions, `states` are the observation's judgePixels().
/// Throws OptionError for bad options and for arguments that don't fit together.
ModelComparison compareModel(const PointModel& model, const WarpGraph& graph,
                             const Observation& observation, const Raster<PixelState>& states,
                             const FusionOptions& options);

/// What became of the points.
struct PointFusionSummary {
  int fused = 0;         // averaged with a measurement
  int contradicted = 0;  // seen through, or not confirmed: lost weight
  ColourGain gain;       // of the image against the model
};

/// Averages every seen point with its measurement, lets go of what is contradicted:
/// docs/fusion.md (F5) to (F13) and (F21) to (F24). A point without any weight left has weight 0;
/// the next keepDensity() removes it. `graph` tells how far points are from their nodes (live
/// positions); points that it doesn't carry count as lying on a node. Throws OptionError for bad
/// options and for arguments that don't fit together.
PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const ModelComparison& comparison, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model);
/// Makes the comparison first, but for the visibility.
PointFusionSummary fusePoints(const WarpGraph& graph, const Observation& observation,
                              const Visibility& visibility, const PointFusionOptions& options,
                              const ColourOptions& colour_options, PointModel* model);

}  // namespace softscope
