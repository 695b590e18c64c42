// src/deform/energy/energy.h: value of the energy of a warp: docs/energy.md (4).
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/energy/constraints.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Weighted terms; their sum is minimised.
struct EnergyTerms {
  double rotation = 0;        // w_rot E_rot
  double regularisation = 0;  // w_reg E_reg
  double rest = 0;            // w_rest E_rest
  double data = 0;            // w_data E_data, robust
  double correspondence = 0;  // w_corr E_corr, robust

  double total() const { return rotation + regularisation + rest + data + correspondence; }
};

/// The energy of one set of transforms.
struct EnergySums {
  EnergyTerms terms;
  double data_abs_sum_mm = 0;  // sum of |residual| over points, unweighted
};

/// With the data required by the normal equations.
struct EnergyValue : EnergySums {
  std::vector<double> residuals;  // one per row of the constraints
  std::vector<double> weights;    // base and robust weight of each row
};

/// Sums in a fixed order, for any number of threads.
void evaluateEnergy(const WarpGraph& graph, const ConstraintSet& constraints,
                    const DeformOptions& options, EnergyValue* value);

/// The four nodes of a stencil side by side.
StencilState gatherStencil(const WarpGraph& graph, const NodeStencil& stencil);

}  // namespace softscope
