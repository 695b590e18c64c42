// src/fusion/visibility.h: visible points of the model in the new frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_model.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/sight.h"

namespace softscope {

/// Visibility of every point of a model, in the model's order.
struct Visibility {
  std::vector<PointSight> points;

  /// Indices of the visible points, ascending.
  std::vector<std::int32_t> seen() const;
};

/// Projective association of the model (world frame, already warped) with the
/// observation: docs/fusion.md (F1) to (F4), with the reasons against a distance
/// field. Points that are not finite are outside. `states` are classifyPixels() of the
/// observation. Throws OptionError for invalid options and inconsistent rasters.
Visibility findVisible(const PointModel& model, const Observation& observation,
                       const Raster<PixelState>& states, const VisibilityOptions& options);

/// Throws OptionError unless `states` belong to the observation.
void requireStates(const Raster<PixelState>& states, const Observation& observation);

/// Throws OptionError unless `visibility` belongs to this model.
void requireVisibility(const Visibility& visibility, const PointModel& model);

}  // namespace softscope
