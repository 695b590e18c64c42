// src/deform/solver/warp_device.h: the least-squares problem of one frame on a device, with rigid
// nodes.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/cholesky/front_tables.h"
#include "deform/kernels/deform_kernels.h"
#include "deform/kernels/depth_look_up.h"
#include "deform/kernels/edge_system.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Options used by a device.
struct WarpWeights {
  double regularisation = 0, rest = 0, data = 0;
  float correspondence = 0;
  RobustOptions data_robust, correspondence_robust;
};

inline WarpWeights warpWeights(const DeformOptions& options) {
  return {options.regularisation_weight, options.rest_weight,
          options.data_weight,           static_cast<float>(options.correspondence_weight),
          options.data_robust,           options.correspondence_robust};
}

/// Model points of the data term, sorted by stencil.
struct WarpPoints {
  int count = 0;
  const Eigen::Vector3f* positions_mm = nullptr;
  const Eigen::Vector3f* normals = nullptr;
  const PointBinding* bindings = nullptr;
  const int* start = nullptr;  // stencils + 1 entries
  float points_each = 1;
};

/// Match and the nodes that carry it: docs/energy.md (12). World frame, mm.
struct WarpMatch {
  float source[3], target[3];
  float sqrt_information[9];  // by rows
  float node_weights[4];
};

/// Memory of the host for the matches of a frame, stencil by stencil.
struct WarpMatches {
  WarpMatch* matches = nullptr;
  int* start = nullptr;  // stencils + 1 entries
};

/// Nodes, edges and their weights.
struct WarpNodes {
  const Eigen::Vector3d* rest_mm = nullptr;
  const NodeTransform* transforms = nullptr;
  const double* hidden = nullptr;
  const double* edge_weights = nullptr;  // stiffness times weight
  const ExpectedOffsets* expected = nullptr;
  double lever_mm = 1;
};

/// Sums of the weights of points per node.
struct NodeLoads {
  std::vector<double> all, seen;
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

/// Residuals, normal equations, their solution and the transforms are on the device.
class WarpDevice {
 public:
  virtual ~WarpDevice() = default;
  virtual void setStructure(const WarpStructure& structure) = 0;
  // Inputs of a frame, for the last structure; all four may be called concurrently. The
  // memory of the host may change after return. A surface without depth gives no targets.
  virtual void setSurface(const DepthLookUp& surface) = 0;
  virtual void setPoints(const WarpPoints& points) = 0;
  /// In place of setPoints(): those of the model on the device that the frame shows. None without
  /// such a model, or if it cannot list them.
  virtual std::optional<NodeLoads> setSeenPoints(const PointModel& model) = 0;
  /// Calls `fill` with memory for so many matches.
  virtual void setMatches(int count, const std::function<void(const WarpMatches&)>& fill) = 0;
  virtual void setNodes(const WarpNodes& nodes) = 0;
  /// New targets and normal equations at the accepted transforms; their energy and the largest
  /// diagonal entry.
  virtual WarpSums linearise() = 0;
  /// Per stencil: targets of the last linearise().
  virtual std::vector<int> targetCounts() = 0;
  /// Step with this damping, and the energy after it.
  virtual WarpSums tryStep(double damping) = 0;
  virtual void acceptStep() = 0;
  virtual std::vector<NodeTransform> transforms() = 0;
};

}  // namespace softscope
