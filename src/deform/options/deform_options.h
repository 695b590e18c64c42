// src/deform/options/deform_options.h: weights of the energy and limits of the solver.
#pragma once

#include <string>

#include "core/point_model.h"

namespace softscope {

/// Node model. Affine is that of the paper: 12 unknowns, close to a
/// rotation by E_rot. Rigid has 6 unknowns, a twist, without E_rot.
enum class NodeModel { kRigid, kAffine };

/// Robust loss for residuals larger than noise: docs/energy.md (13), (14).
enum class RobustLoss { kNone, kHuber };

/// Placement of nodes over the model.
struct GraphOptions {
  double node_spacing_mm = 4.0;  // maximum distance of a point to a node, along the surface
  double cell_mm = 1.0;          // gaps of less than this, up to twice this, count as surface
  // a node carries a point only if the path along the surface
  // is at most this times the straight line (plus two cells)
  static constexpr double kDetourRatio = 1.6;

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Model points in the data term, and their targets: docs/energy.md (9) to (11).
struct AssociationOptions {
  double max_distance_mm = 5.0;                 // epsilon_d
  static constexpr double kMaxAngleDeg = 45.0;  // epsilon_n
  double reference_sigma_mm = 0.15;  // depth of this sigma weighs 1, others by inverse variance;
                                     // 0: all depths weigh 1
  static constexpr double kMaxReliability = 4.0;  // upper limit
  int max_points = 0;  // use an even subset, each standing for many; 0 = all

  void validate() const;
};

/// One term of the energy: docs/energy.md (4).
struct RobustOptions {
  RobustLoss loss = RobustLoss::kNone;
  double scale_mm = 0.5;  // larger residuals are outliers
};

/// Levenberg-Marquardt: docs/energy.md (16) to (19).
struct SolverOptions {
  int max_iterations = 8;      // accepted linear solves, over all associations
  bool follows_tissue = true;  // less stiff where matches say that tissue deforms: (7c)
  static constexpr int kIterationsPerAssociation = 1;
  static constexpr int kMaxRejections = 8;         // consecutive, before the solver stops
  static constexpr double kInitialDamping = 1e-7;  // lambda, relative to the block diagonal
  static constexpr double kDiagonalFloor = 1e-10;  // added, relative to its largest entry
  static constexpr double kMinDamping = 1e-10;
  static constexpr double kMaxDamping = 1e6;
  double step_tolerance_mm = 2e-3;  // converged if no node moves more than this in a step
  double cost_tolerance = 3e-3;     // or if all steps to come gain less than this share of the cost
};

/// Weights of the energy and all other options of stage 6. The defaults are
/// from a simulated sequence with noise (docs/energy.md, "Choice of weights"),
/// for a point spacing of 0.2 mm: E_data grows with the number of points.
struct DeformOptions {
  NodeModel node_model = NodeModel::kRigid;
  double rotation_weight = 40.0;         // w_rot; has no effect on rigid nodes
  double regularisation_weight = 300.0;  // w_reg, of still tissue
  double seen_stiffness = 0.2;           // share of it between nodes with visible points only
  double shape_memory = 0.2;             // share of the mean past shape in the expected shape
  double rest_weight = 0.05;             // w_rest, for invisible nodes
  double data_weight = 3.0;              // w_data
  double correspondence_weight = 60.0;   // w_corr
  RobustOptions data_robust{RobustLoss::kHuber, 1.0};
  RobustOptions correspondence_robust{RobustLoss::kHuber, 0.3};
  AssociationOptions association;
  SolverOptions solver;

  /// Options of the paper: affine nodes, weights 1000, 10000, 1, 1, no robust weights.
  static DeformOptions paper();

  void validate() const;
};

}  // namespace softscope
