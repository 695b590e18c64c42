// src/fusion/back_projection_error.h: distance of the rendered model from the depth of the frame.
#pragma once

#include <limits>

#include "core/point_model.h"
#include "fusion/drawn_points.h"
#include "fusion/observation.h"

namespace softscope {

/// mm, along the optical axis; NaN without comparable pixels.
struct BackProjectionError {
  double mean_mm = std::numeric_limits<double>::quiet_NaN();  // of absolutes: the paper's number
  double p95_mm = std::numeric_limits<double>::quiet_NaN();
  double bias_mm = std::numeric_limits<double>::quiet_NaN();  // mean of model minus measurement
  int compared_px = 0;
};

/// For the model rendered from the pose of the observation: subtracts the
/// measured depth, over the accepted pixels with a point: docs/fusion.md (F19).
/// All differences count. Throws OptionError for inconsistent arguments.
BackProjectionError backProjectionError(const DrawnPoints& drawn, const Observation& observation,
                                        const Raster<PixelState>& states);
/// Renders the model first.
BackProjectionError backProjectionError(const PointModel& model, const Observation& observation,
                                        const Raster<PixelState>& states);

}  // namespace softscope
