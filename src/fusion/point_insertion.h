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

/// What the last frame measured and the model could not explain; NaN elsewhere. Empty before the
/// first frame. Its size is the image's, whatever the model's.
struct InsertionMemory {
  Raster<float> unexplained_mm;
  PinholeCamera left;
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
};

struct InsertionSummary {
  int unexplained_px = 0;  // reliable pixels where the model has no point
  int inserted = 0;        // points added at the model's end
};

/// Adds unbound points where pixels are reliable and the model does not explain them:
/// docs/fusion.md (F14) to (F16). `visibility` is the model's, before new points. An empty model
/// takes the whole image at once; later, with options.confirm, a place must have been
/// unexplained in the last frame too, so that a wrong depth seen once makes no tissue.
/// Throws OptionError for bad options and for arguments that don't fit together.
InsertionSummary insertPoints(const Observation& observation, const Raster<PixelState>& states,
                              const Visibility& visibility, const ColourGain& gain,
                              const FusionOptions& options, InsertionMemory* memory,
                              PointModel* model);

}  // namespace softscope
