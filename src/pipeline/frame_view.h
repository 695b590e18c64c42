// src/pipeline/frame_view.h: masks, pixel states and typical sigma of a measured frame.
#pragma once

#include "core/image.h"
#include "core/rectified_rig.h"
#include "fusion/observation.h"
#include "pipeline/frame_depth.h"
#include "pipeline/model_matches.h"
#include "pipeline/reconstruction_backend.h"
#include "pipeline/reconstruction_options.h"

namespace softscope {

/// One frame, masked and judged; options are scaled to its depths. Rasters have the shape of the
/// rectified left image.
struct FrameView {
  MeasuredFrame measured;
  Mask not_tissue;
  MatchPicture live;  // as it is matched
  Raster<PixelState> states;
  DepthSummary summary;
  AssociationOptions association;
  FusionOptions fusion;
  RansacOptions pose;
};

/// Depends on nothing else: may run ahead.
FrameView viewFrame(MeasuredFrame measured, const RectifiedRig& rig,
                    const ReconstructionOptions& options);

}  // namespace softscope
