// src/fusion/fusion_settings.h: keys, ranges and meanings of the settings of fusion.
#pragma once

#include "core/setting_rules.h"
#include "fusion/fusion_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, PixelOptions& o) {
  v("fusion.max_sigma_mm", o.max_sigma_mm, above(0),
    "depths with a larger predicted sigma are ignored");
}

template <class Visitor>
void describe(Visitor& v, PointFusionOptions& o) {
  v("fusion.truncation_mm", o.truncation_mm, above(0), "larger residuals are not averaged, tau");
  v("fusion.soft_truncation", o.soft_truncation, "weights fall smoothly to 0 at tau");
  v("fusion.max_weight", o.max_weight, atLeast(1), "largest weight of a point, omega_max");
  v("fusion.reference_sigma_mm", o.reference_sigma_mm, atLeast(0),
    "depth of this sigma has weight 1; 0: all depths have");
  v("fusion.max_measurement_weight", o.max_measurement_weight, above(0),
    "largest weight of a depth");
  v("fusion.node_trust", o.node_trust,
    ChoiceRule<NodeTrust>{{{"equal", NodeTrust::kEqual},
                           {"warp-noise", NodeTrust::kWarpNoise},
                           {"paper", NodeTrust::kPaper}}},
    "weight of a warped point by the distance of its nodes");
  v("fusion.follow_innovation", o.follow_innovation,
    "the model's weight falls where frames differ by more than their sigma");
  v("fusion.buried_mm", o.buried_mm, atLeast(0),
    "points less than this behind the measured surface lose weight");
}

template <class Visitor>
void describe(Visitor& v, ColourOptions& o) {
  v("colour.compensate_gain", o.compensate_gain, "of the frame against the model, per channel");
  v("colour.max_weight", o.max_weight, atLeast(0), "new colours have at least 1 / (1 + this)");
  v("colour.hold_anchors", o.hold_anchors,
    "keep the reference intensity of matches where the image agrees with it");
  v("colour.highlight_level", o.highlight_level, between(1, 256),
    "brighter in all channels is a specular highlight; 256: none");
  v("colour.brightening_limit", o.brightening_limit, between(1, 256),
    "so much brighter than the point is a specular highlight; 256: none");
}

template <class Visitor>
void describe(Visitor& v, InsertionOptions& o) {
  v("fusion.point_spacing_mm", o.spacing_mm, atLeast(0.01), "of the model's points");
  v("fusion.insert_confirm", o.confirm, "two frames in a row must agree");
}

template <class Visitor>
void describe(Visitor& v, FusionOptions& o) {
  describe(v, o.pixels);
  describe(v, o.points);
  describe(v, o.insertion);
  describe(v, o.colour);
}

}  // namespace softscope
