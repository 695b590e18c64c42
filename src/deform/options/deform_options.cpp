#include "deform/options/deform_options.h"

#include "core/error.h"
#include "deform/options/deform_settings.h"

namespace softscope {

void GraphOptions::validate() const {
  requireAllowed(*this);
  require(cell_mm > 0 && cell_mm <= node_spacing_mm / 2, "graph.node_spacing_mm", node_spacing_mm,
          "must be at least twice the cell of the graph");
}

void AssociationOptions::validate() const { requireAllowed(*this); }

DeformOptions DeformOptions::paper() {
  DeformOptions options;
  options.node_model = NodeModel::kAffine;
  options.rotation_weight = 1e3;
  options.regularisation_weight = 1e4;
  options.seen_stiffness = 1;
  options.shape_memory = 0;
  options.rest_weight = 0;
  options.data_weight = 1;
  options.correspondence_weight = 1;
  options.data_robust.loss = RobustLoss::kNone;
  options.correspondence_robust.loss = RobustLoss::kNone;
  options.association.max_distance_mm = 2;
  options.association.reference_sigma_mm = 0;
  options.solver.follows_tissue = false;
  options.solver.cost_tolerance = 1e-3;
  return options;
}

void DeformOptions::validate() const { requireAllowed(*this); }

}  // namespace softscope
