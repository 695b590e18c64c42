// src/deform/options/deform_settings.h: keys, ranges and meanings of the settings of graph and
// deformation.
#pragma once

#include "core/setting_rules.h"
#include "deform/options/deform_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, GraphOptions& o) {
  v("graph.node_spacing_mm", o.node_spacing_mm, atLeast(0.5), "of the nodes, along the surface");
}

template <class Visitor>
void describe(Visitor& v, AssociationOptions& o) {
  v("deform.max_distance_mm", o.max_distance_mm, above(0),
    "largest distance of point and depth, epsilon_d");
  v("deform.reference_sigma_mm", o.reference_sigma_mm, atLeast(0),
    "depth of this sigma has weight 1; 0: all depths have");
}

inline ChoiceRule<RobustLoss> robustLosses() {
  return {{{"none", RobustLoss::kNone}, {"huber", RobustLoss::kHuber}}};
}

template <class Visitor>
void describe(Visitor& v, DeformOptions& o) {
  v("deform.node_model", o.node_model,
    ChoiceRule<NodeModel>{{{"rigid", NodeModel::kRigid}, {"affine", NodeModel::kAffine}}},
    "motion of a node: 6 or 12 unknowns");
  v("deform.rotation_weight", o.rotation_weight, atLeast(0), "w_rot; for affine nodes alone");
  v("deform.regularisation_weight", o.regularisation_weight, atLeast(0),
    "w_reg; by default less where tissue deforms");
  v("deform.seen_stiffness", o.seen_stiffness, aboveUpTo(0, 1),
    "factor of w_reg between nodes in sight");
  v("deform.shape_memory", o.shape_memory, between(0, 1),
    "share of the shape of the last 100 frames in what nodes expect of each other");
  v("deform.rest_weight", o.rest_weight, atLeast(0), "w_rest, for nodes out of sight");
  v("deform.data_weight", o.data_weight, atLeast(0), "w_data");
  v("deform.correspondence_weight", o.correspondence_weight, atLeast(0),
    "w_corr; 0: matches constrain the pose and not the warp");
  v("deform.data_loss", o.data_robust.loss, robustLosses(), "robust loss of E_data");
  v("deform.correspondence_loss", o.correspondence_robust.loss, robustLosses(),
    "robust loss of E_corr");
  describe(v, o.association);
}

}  // namespace softscope
