// src/deform/warp_device.h: the least-squares problem of one frame on a device, with rigid nodes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/deform_options.h"
#include "deform/depth_look_up.h"
#include "deform/edge_system.h"
#include "deform/front_tables.h"
#include "deform/kernels.h"

namespace softscope {

/// What a device needs of the options.
struct WarpWeights {
  double regularisation = 0, rest = 0, data = 0;
  RobustOptions data_robust, correspondence_robust;
};

inline WarpWeights warpWeights(const DeformOptions& options) {
  return {options.regularisation_weight, options.rest_weight, options.data_weight,
          options.data_robust, options.correspondence_robust};
}

/// Points and matches lie stencil by stencil. The memory is the caller's.
struct WarpFrame {
  const Eigen::Vector3d* rest_mm = nullptr;  // per node
  const NodeTransform* transforms = nullptr;
  const double* hidden = nullptr;
  const double* edge_weights = nullptr;  // stiffness times weight
  const ExpectedOffsets* expected = nullptr;
  int points = 0;
  const Eigen::Vector3f* positions_mm = nullptr;
  const Eigen::Vector3f* normals = nullptr;
  const PointBinding* bindings = nullptr;
  const int* point_start = nullptr;  // stencils + 1 entries
  float points_each = 1;
  int match_rows = 0;  // three a match
  const PlaneConstraint* matches = nullptr;
  const int* match_start = nullptr;  // rows; stencils + 1 entries
  double lever_mm = 1;
};

/// Sums over a frame.
struct WarpSums {
  double data = 0, correspondence = 0, data_abs_mm = 0, points = 0;  // robust; weighted by rows
  double edges = 0, rest = 0;                                        // without w_reg, w_rest
  double predicted_decrease = 0;
  double largest_diagonal = 0, furthest_mm = 0;
  double least_inverse_pivot = 0, largest_inverse_pivot = 0;
  double failures = 0;  // pivots not above 0, steps not finite
};

/// Residuals, normal equations, their solution and the transforms live on the device.
class WarpDevice {
 public:
  virtual ~WarpDevice() = default;
  virtual void setStructure(const WarpStructure& structure) = 0;
  /// `surface`: pointers to the host's memory; no depth: points get no targets.
  virtual void setSurface(const DepthLookUp& surface) = 0;
  /// For the last structure. The memory may change when it returns.
  virtual void setFrame(const WarpFrame& frame) = 0;
  /// New targets and normal equations at the accepted transforms; their energy and the largest
  /// diagonal entry.
  virtual WarpSums linearise() = 0;
  /// Per stencil: targets of the last linearise().
  virtual std::vector<int> targetCounts() = 0;
  /// A step with this damping, and the energy after it.
  virtual WarpSums tryStep(double damping) = 0;
  virtual void acceptStep() = 0;
  virtual std::vector<NodeTransform> transforms() = 0;
};

}  // namespace softscope
