// src/pipeline/reconstruction_options.h: options of a reconstruction.
#pragma once

#include "deform/options/deform_options.h"
#include "features/matcher_options.h"
#include "features/model_view.h"
#include "fusion/fusion_options.h"
#include "pipeline/frame_depth.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

/// Which frames are good enough to change the model.
struct GateOptions {
  double min_coverage = 0.1;     // share of the unmasked pixels that have depth
  double max_residual_mm = 2.0;  // mean distance of the warped model from the depth
  double min_explained = 0.3;    // share of the points in sight that the depth still pulls
  double min_confidence = 0.1;   // of the evidence for pose and warp: docs/fusion.md (F27)
  static constexpr int kMaxKeyViews = 12;        // poses kept to find the model again after a loss
  static constexpr double kKeyViewStepMm = 10;   // the scope moved this far from all of them …
  static constexpr double kKeyViewStepDeg = 15;  // … or turned this much: another key view
};

/// What of the image is not tissue.
struct TissueMaskOptions {
  int margin_px = 6;  // pixels this near to a masked one are left out: the stereo window's reach
  bool detect_instruments = false;  // by colour, beside mask files
};

/// One struct a stage, in the order of the loop.
struct ReconstructionOptions {
  FrameDepthOptions depth;
  TissueMaskOptions tissue;
  ModelViewOptions model_view;
  MatcherOptions matcher;
  RansacOptions pose;
  RefinePoseOptions refine_pose;  // 0 iterations: RANSAC's fit is the pose
  GraphOptions graph;
  DeformOptions deform;
  bool match_last_picture = false;  // true: frame to frame, on the last image's texture, not on
                                    // the model's; errors add up. For comparison
  FusionOptions fusion;
  GateOptions gate;

  /// The paper's choice throughout.
  static ReconstructionOptions paper();

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// `options` with each quantity that several stages need at its one setting's value:
/// fusion.point_spacing_mm and graph.node_spacing_mm.
ReconstructionOptions withSharedQuantities(ReconstructionOptions options);

}  // namespace softscope
