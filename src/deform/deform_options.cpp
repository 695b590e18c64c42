#include "deform/deform_options.h"

#include "core/error.h"
#include "deform/deform_settings.h"

namespace softscope {

void GraphOptions::validate() const {
  requireAllowed(*this);
  require(cell_mm <= node_spacing_mm / 2, "graph.cell_mm", cell_mm,
          "must be at most half of graph.node_spacing_mm");
}

void AssociationOptions::validate() const { requireAllowed(*this); }

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
  requireAllowed(*this);
  require(solver.initial_damping >= solver.min_damping &&
              solver.initial_damping <= solver.max_damping,
          "deform.initial_damping", solver.initial_damping,
          "must lie between deform.min_damping and deform.max_damping");
}

}  // namespace softscope
