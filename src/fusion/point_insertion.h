// src/fusion/point_insertion.h: new points from measurements that the model does not explain.
#pragma once

#include <Eigen/Geometry>

#include "core/camera.h"
#include "core/point_model.h"
#include "core/raster.h"
#include "fusion/colour_gain.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// Measured depths of the last frame unexplained by the model; NaN
/// elsewhere. Empty before the first frame. Of the size of the image.
struct InsertionMemory {
  Raster<float> unexplained_mm;
  PinholeCamera left;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

struct InsertionSummary {
  int unexplained_px = 0;  // accepted pixels without a model point
  int inserted = 0;        // points added at the model's end
};

/// Adds unbound points at accepted pixels that the model does not explain:
/// docs/fusion.md (F14) to (F16). `visibility` is that of the model before new points.
/// An empty model is initialised with the whole image; later, with options.confirm, a
/// position must be unexplained in the last frame too, so that a single wrong depth
/// creates no tissue. Throws OptionError for invalid options and inconsistent arguments.
InsertionSummary insertPoints(const Observation& observation, const Raster<PixelState>& states,
                              const Visibility& visibility, const ColourGain& gain,
                              const FusionOptions& options, InsertionMemory* memory,
                              PointModel* model);

}  // namespace softscope
