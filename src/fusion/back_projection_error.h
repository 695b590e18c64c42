// src/fusion/back_projection_error.h: distance of the rendered model from the frame's depth.
#pragma once

#include <limits>

#include "core/point_model.h"
#include "fusion/drawn_points.h"
#include "fusion/observation.h"

namespace softscope {

/// mm, along the optical axis; NaN where nothing could be compared.
struct BackProjectionError {
  double mean_mm = std::numeric_limits<double>::quiet_NaN();  // of absolutes: the paper's number
  double p95_mm = std::numeric_limits<double>::quiet_NaN();
  double bias_mm = std::numeric_limits<double>::quiet_NaN();  // mean of model minus measurement
  int compared_px = 0;
};

/// Of the model drawn from the observation's pose: subtracts the measured depth, over the pixels
/// that are reliable and show a point: docs/fusion.md (F19). No difference is too large to count.
/// Throws OptionError where the arguments don't fit together.
BackProjectionError backProjectionError(const DrawnPoints& drawn, const Observation& observation,
                                        const Raster<PixelState>& states);
/// Draws the model first.
BackProjectionError backProjectionError(const PointModel& model, const Observation& observation,
                                        const Raster<PixelState>& states);

}  // namespace softscope
