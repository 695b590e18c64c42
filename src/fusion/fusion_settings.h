// src/fusion/fusion_settings.h: keys, ranges and meanings of the settings of fusion.
#pragma once

#include "core/setting_rules.h"
#include "fusion/fusion_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, PixelOptions& o) {
  v("fusion.max_depth_mm", o.max_depth_mm, above(0), "larger depths are ignored");
  v("fusion.max_sigma_mm", o.max_sigma_mm, above(0),
    "depths with a larger predicted sigma are ignored");
  v("fusion.edge_step", o.edge_step, above(0),
    "larger steps, as a share of the depth, are depth discontinuities");
  v("fusion.edge_radius_px", o.edge_radius_px, between(0, 16),
    "pixels this near to a depth discontinuity are ignored");
  v("fusion.min_cosine", o.min_cosine, fromToBelow(0.01, 1),
    "pixels with a smaller cosine of normal and ray are ignored");
}

template <class Visitor>
void describe(Visitor& v, VisibilityOptions& o) {
  v("fusion.visible_distance_mm", o.max_distance_mm, above(0),
    "largest distance of a visible point from the depth, epsilon_d");
  v("fusion.visible_angle_deg", o.max_angle_deg, aboveUpTo(0, 90),
    "largest angle of both normals, epsilon_n");
  v("fusion.occlusion_mm", o.occlusion_mm, above(0),
    "points this far behind the front surface are hidden");
  v("fusion.occlusion_cell_px", o.occlusion_cell_px, between(1, 64),
    "resolution of the front surface");
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
                           {"nearer", NodeTrust::kNearer},
                           {"paper", NodeTrust::kPaper}}},
    "weight of a warped point by the distance of its nodes");
  v("fusion.node_spacing_mm", o.node_spacing_mm, above(0), "epsilon of the paper");
  v("fusion.warp_sigma_mm", o.warp_sigma_mm, atLeast(0), "error of one warp away from nodes");
  v("fusion.along_ray", o.along_ray, "points move along their ray alone");
  v("fusion.contradiction_loss", o.contradiction_loss, between(0, 1),
    "share of its weight that a point loses by a free-space violation");
  v("fusion.follow_innovation", o.follow_innovation,
    "the model's weight falls where frames differ by more than their sigma");
  v("fusion.buried_mm", o.buried_mm, atLeast(0),
    "points less than this behind the measured surface lose weight");
  v("fusion.confirmed_weight", o.confirmed_weight, atLeast(0),
    "points of a smaller weight lose it where they are not measured again");
}

template <class Visitor>
void describe(Visitor& v, ColourOptions& o) {
  v("colour.compensate_gain", o.compensate_gain, "of the frame against the model, per channel");
  v("colour.illumination", o.illumination,
    ChoiceRule<Illumination>{
        {{"none", Illumination::kNone}, {"headlight", Illumination::kHeadlight}}},
    "model of the light");
  v("colour.reference_distance_mm", o.reference_distance_mm, above(0), "of the headlight");
  v("colour.gamma", o.gamma, between(1, 3), "of the images' encoding");
  v("colour.max_weight", o.max_weight, atLeast(0), "new colours have at least 1 / (1 + this)");
  v("colour.anchor_weight", o.anchor_weight, atLeast(0),
    "the same for the reference intensity of matches");
  v("colour.highlight_level", o.highlight_level, between(1, 256),
    "brighter in all channels is a specular highlight; 256: none");
  v("colour.brightening_limit", o.brightening_limit, between(1, 256),
    "so much brighter than the point is a specular highlight; 256: none");
}

template <class Visitor>
void describe(Visitor& v, InsertionOptions& o) {
  v("fusion.insert_spacing_mm", o.spacing_mm, atLeast(0.01), "between new points");
  v("fusion.insert_max_sigma_mm", o.max_sigma_mm, above(0),
    "depths with a larger predicted sigma make no points");
  v("fusion.insert_band_mm", o.band_mm, above(0), "a model point this near explains a pixel");
  v("fusion.insert_confirm", o.confirm, "two frames in a row must agree");
}

template <class Visitor>
void describe(Visitor& v, DensityOptions& o) {
  v("fusion.cell_mm", o.cell_mm, atLeast(0.01), "at most one point per cell and side");
  v("fusion.cell_angle_deg", o.max_angle_deg, aboveUpTo(0, 90),
    "largest angle of normals of points that are merged");
}

template <class Visitor>
void describe(Visitor& v, FusionOptions& o) {
  describe(v, o.pixels);
  describe(v, o.visibility);
  describe(v, o.points);
  describe(v, o.insertion);
  describe(v, o.density);
  describe(v, o.colour);
}

}  // namespace softscope
