#include "deform/deform_options.h"

#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

void requireAbove(const std::string& field, double value, double bound) {
  require(std::isfinite(value) && value > bound, field, value,
          "must be above " + std::to_string(bound));
}

void requireNotNegative(const std::string& field, double value) {
  require(std::isfinite(value) && value >= 0, field, value, "can't be negative");
}

void validateRobust(const RobustOptions& robust, const std::string& field) {
  requireAbove(field + ".scale_mm", robust.scale_mm, 0);
}

}  // namespace

void GraphOptions::validate() const {
  requireAbove("graph.node_spacing_mm", node_spacing_mm, 0);
  requireAbove("graph.cell_mm", cell_mm, 0);
  require(cell_mm <= node_spacing_mm / 2, "graph.cell_mm", cell_mm,
          "must be at most half of graph.node_spacing_mm");
  require(detour_ratio >= 1, "graph.detour_ratio", detour_ratio, "must be 1 or more");
}

void AssociationOptions::validate() const {
  requireAbove("deform.association.max_distance_mm", max_distance_mm, 0);
  require(max_angle_deg > 0 && max_angle_deg <= 90, "deform.association.max_angle_deg",
          max_angle_deg, "must lie above 0 and be at most 90");
  requireNotNegative("deform.association.reference_sigma_mm", reference_sigma_mm);
  requireAbove("deform.association.max_reliability", max_reliability, 0);
  require(max_points >= 0, "deform.association.max_points", max_points, "can't be negative");
}

void SolverOptions::validate() const {
  require(max_iterations >= 1, "deform.solver.max_iterations", max_iterations, "must be 1 or more");
  require(iterations_per_association >= 1, "deform.solver.iterations_per_association",
          iterations_per_association, "must be 1 or more");
  require(max_rejections >= 1, "deform.solver.max_rejections", max_rejections, "must be 1 or more");
  requireAbove("deform.solver.min_damping", min_damping, 0);
  require(initial_damping >= min_damping && initial_damping <= max_damping,
          "deform.solver.initial_damping", initial_damping,
          "must lie between min_damping and max_damping");
  requireAbove("deform.solver.max_damping", max_damping, 0);
  requireNotNegative("deform.solver.step_tolerance_mm", step_tolerance_mm);
  requireNotNegative("deform.solver.cost_tolerance", cost_tolerance);
}

DeformOptions DeformOptions::paper() {
  DeformOptions options;
  options.node_model = NodeModel::kAffine;
  options.rotation_weight = 1e3;
  options.regularisation_weight = 1e4;
  options.seen_stiffness = 1;
  options.rest_weight = 0;
  options.data_weight = 1;
  options.correspondence_weight = 1;
  options.data_robust.loss = RobustLoss::kNone;
  options.correspondence_robust.loss = RobustLoss::kNone;
  options.association.max_distance_mm = 2;
  options.association.reference_sigma_mm = 0;
  return options;
}

void DeformOptions::validate() const {
  requireNotNegative("deform.rotation_weight", rotation_weight);
  requireNotNegative("deform.regularisation_weight", regularisation_weight);
  require(seen_stiffness > 0 && seen_stiffness <= 1, "deform.seen_stiffness", seen_stiffness,
          "must be above 0 and at most 1");
  requireNotNegative("deform.rest_weight", rest_weight);
  requireNotNegative("deform.data_weight", data_weight);
  requireNotNegative("deform.correspondence_weight", correspondence_weight);
  validateRobust(data_robust, "deform.data_robust");
  validateRobust(correspondence_robust, "deform.correspondence_robust");
  association.validate();
  solver.validate();
}

}  // namespace softscope
