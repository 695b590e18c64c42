// src/pipeline/options/reconstruction_settings.h: keys, ranges and meanings of a reconstruction's
// settings.
#pragma once

#include "core/setting_rules.h"
#include "deform/options/deform_settings.h"
#include "features/feature_settings.h"
#include "fusion/fusion_settings.h"
#include "pipeline/options/reconstruction_options.h"
#include "pose/pose_settings.h"
#include "stereo/options/stereo_settings.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, FrameDepthOptions& o) {
  v("depth.source", o.source, oneOf({"auto", "stereo", "files"}),
    "stereo, or the sequence's depth/; auto: depth/ where it is there");
  v("depth.align_rows", o.align_rows, "measure and remove vertical disparity above 0.2 px");
  v("depth.find_border", o.find_border,
    "mask even borders of the views, black or grey, before matching");
  describe(v, o.stereo);
  v("tissue.detect_instruments", o.detect_instruments,
    "drop surfaces without red that are apart from the tissue: instruments without a mask, smoke");
}

template <class Visitor>
void describe(Visitor& v, TissueMaskOptions& o) {
  v("tissue.margin_px", o.margin_px, between(0, 100), "dilation of the ignored pixels");
}

template <class Visitor>
void describe(Visitor& v, GateOptions& o) {
  v("gate.min_coverage", o.min_coverage, between(0, 1), "least share of the tissue with depth");
  v("gate.max_residual_mm", o.max_residual_mm, above(0),
    "largest mean distance of the warped model from the depth");
  v("gate.min_explained", o.min_explained, between(0, 1),
    "least share of the points in sight with a target");
  v("gate.min_confidence", o.min_confidence, between(0, 1), "least agreement of model and frame");
}

template <class Visitor>
void describe(Visitor& v, ReconstructionOptions& o) {
  describe(v, o.depth);
  describe(v, o.tissue);
  describe(v, o.matcher);
  v("matcher.last_picture", o.match_last_picture,
    "match the previous image and not the model, for comparison");
  describe(v, o.pose);
  describe(v, o.refine_pose);
  describe(v, o.graph);
  describe(v, o.deform);
  describe(v, o.fusion);
  describe(v, o.gate);
}

}  // namespace softscope
