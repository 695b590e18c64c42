// src/deform/graph/carrier_finder.h: nodes of a point, and their skinning weights.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

#include "core/warp_graph.h"
#include "deform/graph/node_reach.h"

namespace softscope {

/// Nearest nodes of a cell, by number, with weights of docs/energy.md (25).
struct Carriers {
  NodeStencil stencil{};
  std::array<float, kNodesPerPoint> weights{};
};

/// Finds the nodes of points in sequence, fastest if points of one
/// cell are consecutive. The results do not depend on the order.
class CarrierFinder {
 public:
  CarrierFinder(const NodeReach& reach, const WarpGraph& graph, double spacing_mm)
      : reach_(reach), graph_(graph), spacing_mm_(spacing_mm) {}

  /// The cell must have a node.
  Carriers find(int cell, const Eigen::Vector3f& point_mm);

 private:
  static constexpr int kSorted = kNodesPerPoint + 1;
  using NodeDistance = std::pair<double, int>;

  void sortNodes(int cell, const Eigen::Vector3d& point_mm);
  void insert(int end, const NodeDistance& node);

  const NodeReach& reach_;
  const WarpGraph& graph_;
  double spacing_mm_;
  int cell_ = -1, count_ = 0;
  std::array<NodeDistance, NodeReach::kNearest> nodes_;  // of cell_; the first kSorted by distance
};

}  // namespace softscope
