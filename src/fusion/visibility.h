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

  /// Indices of the points that are seen, ascending.
  std::vector<std::int32_t> seen() const;
};

/// Projective association of the model (world frame, already warped) with the observation:
/// docs/fusion.md (F1) to (F4), which says why no distance field is built. Points that aren't
/// finite are outside. `states` are the observation's judgePixels().
/// Throws OptionError for bad options and for rasters that don't fit together.
Visibility findVisible(const PointModel& model, const Observation& observation,
                       const Raster<PixelState>& states, const VisibilityOptions& options);

/// Throws OptionError where `states` are not the observation's.
void requireStates(const Raster<PixelState>& states, const Observation& observation);

/// Throws OptionError where `visibility` is not about this model.
void requireVisibility(const Visibility& visibility, const PointModel& model);

}  // namespace softscope
