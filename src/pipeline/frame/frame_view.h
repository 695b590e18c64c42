// src/pipeline/frame/frame_view.h: masks, pixel states and typical sigma of a measured frame.
#pragma once

#include <future>

#include "core/image.h"
#include "core/rectified_rig.h"
#include "fusion/frame_survey.h"
#include "fusion/observation.h"
#include "pipeline/frame/depth_summary.h"
#include "pipeline/frame/frame_depth.h"
#include "pipeline/frame/model_matches.h"
#include "pipeline/options/reconstruction_options.h"
#include "stereo/depth/levelled_relief.h"

namespace softscope {

/// One frame, masked and judged; options are scaled to its depths. Rasters have the shape of the
/// rectified left image.
struct FrameView {
  int serial = 0;  // differs between frames of one FrameAhead
  MeasuredFrame measured;
  Mask not_tissue;
  MatchPicture live;  // as it is matched
  Raster<PixelState> states;
  std::shared_future<LevelledRelief> levelled;  // found beside the stages before fusion
  DepthSummary summary;
  AssociationOptions association;
  FusionOptions fusion;
  RansacOptions pose;
};

/// References to members of the view.
inline Observation observationOf(
    const FrameView& view, const PinholeCamera& left,
    const Eigen::Isometry3d& world_from_left = Eigen::Isometry3d::Identity()) {
  return {view.measured.depth, view.measured.normals, view.measured.left, view.not_tissue, left,
          world_from_left};
}

/// What the rectified left image and its masks alone tell of a frame.
struct FramePictures {
  Mask not_tissue;
  MatchPicture live;
  int dark_px = 0;  // of what is not masked, too dark to be measured
};

/// Both depend on nothing else, and may run ahead: the first before the frame is measured.
FramePictures framePictures(const FrameViews& views, const ReconstructionOptions& options);
FrameView viewFrame(MeasuredFrame measured, FramePictures pictures, const RectifiedRig& rig,
                    const ReconstructionOptions& options, FrameSurvey* survey);
/// The same on the CPU, where the pictures are still to be made.
FrameView viewFrame(MeasuredFrame measured, const RectifiedRig& rig,
                    const ReconstructionOptions& options);

}  // namespace softscope
