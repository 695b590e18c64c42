// src/pipeline/options/reconstruction_options.h: options of a reconstruction.
#pragma once

#include "deform/options/deform_options.h"
#include "features/matcher_options.h"
#include "features/model_view.h"
#include "fusion/fusion_options.h"
#include "pipeline/options/frame_depth_options.h"
#include "pose/ransac_pose.h"
#include "pose/refine_pose.h"

namespace softscope {

/// Conditions for a frame to update the model.
struct GateOptions {
  double min_coverage = 0.1;     // share of the tissue with depth
  double max_residual_mm = 2.0;  // mean distance of the warped model from the depth
  double min_explained = 0.3;    // share of visible points that the depth still constrains
  double min_confidence = 0.1;   // agreement of model and frame: docs/fusion.md (F27)
  static constexpr double kMaxPoseSigmaDeg = 10;  // beyond it, the matches determine no pose
  // Of a frame that is fused at the last pose, without one of its own. By chance ten blocks reach
  // that agreement once in 4000 times.
  static constexpr double kMinAssumedAgreement = 0.5;
  static constexpr int kMinAssumedBlocks = 10;
  static constexpr int kMaxKeyViews = 12;        // poses kept for relocalisation after a loss
  static constexpr double kKeyViewStepMm = 10;   // distance of the scope from all of them …
  static constexpr double kKeyViewStepDeg = 15;  // … or rotation that adds a key view
};

/// Parts of the image that are not tissue.
struct TissueMaskOptions {
  int margin_px = 6;  // pixels this close to a masked one are left out: reach of the stereo window
};

/// One struct per stage, in the order of the loop.
struct ReconstructionOptions {
  FrameDepthOptions depth;
  TissueMaskOptions tissue;
  ModelViewOptions model_view;
  MatcherOptions matcher;
  RansacOptions pose;
  RefinePoseOptions refine_pose;  // 0 iterations: the pose is that of RANSAC
  GraphOptions graph;
  DeformOptions deform;
  bool match_last_picture = false;  // true: frame to frame, on the last image's texture, not on
                                    // the model's; errors add up. For comparison
  FusionOptions fusion;
  GateOptions gate;

  /// The options of the paper.
  static ReconstructionOptions paper();

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// `options` with each quantity that several stages need set from its
/// one setting: fusion.point_spacing_mm and graph.node_spacing_mm.
ReconstructionOptions withSharedQuantities(ReconstructionOptions options);

}  // namespace softscope
