// src/deform/deform_settings.h: keys, ranges and meanings of the settings of graph and deformation.
#pragma once

#include "core/setting_rules.h"
#include "deform/deform_options.h"

namespace softscope {

template <class Visitor>
void describe(Visitor& v, GraphOptions& o) {
  v("graph.node_spacing_mm", o.node_spacing_mm, above(0), "of the nodes, along the surface");
  v("graph.cell_mm", o.cell_mm, above(0),
    "gaps of less than this count as surface; at most half of node_spacing_mm");
  v("graph.detour_ratio", o.detour_ratio, atLeast(1),
    "largest way along the surface over straight line");
  v("graph.edge_weighting", o.edge_weighting,
    ChoiceRule<EdgeWeighting>{
        {{"uniform", EdgeWeighting::kUniform}, {"distance", EdgeWeighting::kDistance}}},
    "weights of the graph's edges");
}

template <class Visitor>
void describe(Visitor& v, AssociationOptions& o) {
  v("deform.max_distance_mm", o.max_distance_mm, above(0),
    "largest distance of point and depth, epsilon_d");
  v("deform.max_angle_deg", o.max_angle_deg, aboveUpTo(0, 90),
    "largest angle of both normals, epsilon_n");
  v("deform.reference_sigma_mm", o.reference_sigma_mm, atLeast(0),
    "depth of this sigma has weight 1; 0: all depths have");
  v("deform.max_reliability", o.max_reliability, above(0), "largest weight of a depth");
  v("deform.max_points", o.max_points, atLeast(0), "an even subset; 0: all points");
}

template <class Visitor>
void describe(Visitor& v, SolverOptions& o) {
  v("deform.max_iterations", o.max_iterations, atLeast(1), "accepted steps of Levenberg-Marquardt");
  v("deform.iterations_per_association", o.iterations_per_association, atLeast(1),
    "steps between two searches for target points");
  v("deform.max_rejections", o.max_rejections, atLeast(1), "rejected steps in a row");
  v("deform.initial_damping", o.initial_damping, above(0),
    "of Levenberg-Marquardt; between min_damping and max_damping");
  v("deform.min_damping", o.min_damping, above(0), "of Levenberg-Marquardt");
  v("deform.max_damping", o.max_damping, above(0), "of Levenberg-Marquardt");
  v("deform.step_tolerance_mm", o.step_tolerance_mm, atLeast(0), "smaller steps end the search");
  v("deform.cost_tolerance", o.cost_tolerance, atLeast(0),
    "smaller relative decreases of the cost end the search");
}

inline ChoiceRule<RobustLoss> robustLosses() {
  return {
      {{"none", RobustLoss::kNone}, {"huber", RobustLoss::kHuber}, {"tukey", RobustLoss::kTukey}}};
}

template <class Visitor>
void describe(Visitor& v, DeformOptions& o) {
  v("deform.node_model", o.node_model,
    ChoiceRule<NodeModel>{{{"rigid", NodeModel::kRigid}, {"affine", NodeModel::kAffine}}},
    "motion of a node: 6 or 12 unknowns");
  v("deform.rotation_weight", o.rotation_weight, atLeast(0), "w_rot; for affine nodes alone");
  v("deform.regularisation_weight", o.regularisation_weight, atLeast(0), "w_reg");
  v("deform.seen_stiffness", o.seen_stiffness, aboveUpTo(0, 1),
    "factor of w_reg between nodes in sight");
  v("deform.rest_weight", o.rest_weight, atLeast(0), "w_rest, for nodes out of sight");
  v("deform.data_weight", o.data_weight, atLeast(0), "w_data");
  v("deform.correspondence_weight", o.correspondence_weight, atLeast(0), "w_corr");
  v("deform.data_loss", o.data_robust.loss, robustLosses(), "robust loss of E_data");
  v("deform.data_scale_mm", o.data_robust.scale_mm, above(0), "scale of E_data's robust loss");
  v("deform.correspondence_loss", o.correspondence_robust.loss, robustLosses(),
    "robust loss of E_corr");
  v("deform.correspondence_scale_mm", o.correspondence_robust.scale_mm, above(0),
    "scale of E_corr's robust loss");
  describe(v, o.association);
  describe(v, o.solver);
}

}  // namespace softscope
