// src/fusion/innovation.h: innovation: distance of a frame's depth from the warped model.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/hd.h"
#include "core/point_model.h"
#include "core/warp_graph.h"
#include "fusion/fusion_options.h"
#include "fusion/observation.h"
#include "fusion/visibility.h"

namespace softscope {

/// Mean squares around a position on the tissue, mm²: docs/fusion.md (F21), (F22).
struct Innovation {
  float difference_mm2 = 0;  // of measurement and warped model, along the ray
  float excess_mm2 = 0;      // difference of measurement and warped model, along the ray
};

/// Whether the point has nodes of a graph with that many stencils.
SOFTSCOPE_HD inline bool isCarried(const PointBinding& binding, std::int32_t stencils) {
  return binding.stencil != PointBinding::kUnbound && binding.stencil < stencils;
}

/// Interpolated from the nodes of a point by its skinning weights.
SOFTSCOPE_HD inline Innovation innovationAt(const NodeStencil& stencil, const PointBinding& binding,
                                            const Innovation* nodes) {
  Innovation here;
  for (int k = 0; k < kNodesPerPoint; ++k) {
    here.difference_mm2 += binding.weights[k] * nodes[stencil[k]].difference_mm2;
    here.excess_mm2 += binding.weights[k] * nodes[stencil[k]].excess_mm2;
  }
  return here;
}

/// Mean of a quantity around a node, from its weighted total there and
/// over the frame. A node with few points gets the mean of the frame.
SOFTSCOPE_HD inline double innovationMean(double total, double weight, double frame_total,
                                          double frame_weight) {
  constexpr double kPriorPoints = 5;  // that the frame counts as
  const double prior = kPriorPoints * frame_total / frame_weight;
  return (total + prior) / (weight + kPriorPoints);
}

/// Difference limited to three standard deviations of those around it: single
/// wrong depths are not informative. `around_mm`: mean absolute difference there.
SOFTSCOPE_HD inline double countedDifference(double away_mm, double around_mm) {
  constexpr double kLargest =
      3 * 1.2533141373155001;  // standard deviation over mean absolute value
  const double limit_mm = kLargest * around_mm;
  return limit_mm < away_mm ? limit_mm : away_mm;
}

/// Innovation of the visible points around each node.
/// Empty, and 0 everywhere, without known depth errors.
class InnovationField {
 public:
  InnovationField() = default;

  /// `graph` has live positions, `visibility` belongs to `model`.
  InnovationField(const PointModel& model, const WarpGraph& graph, const Observation& observation,
                  const Visibility& visibility, const PointFusionOptions& options);

  /// From the means around each node.
  explicit InnovationField(std::vector<Innovation> nodes) : nodes_(std::move(nodes)) {}

  /// innovationAt() of a point; 0 without nodes.
  Innovation at(const WarpGraph& graph, const PointBinding& binding) const;

  /// One per node; may be empty.
  const std::vector<Innovation>& nodes() const { return nodes_; }

 private:
  std::vector<Innovation> nodes_;
};

}  // namespace softscope
