// src/deform/graph/carrier_finder.h: the nodes that carry a point, and their weights.
#pragma once

#include <Eigen/Core>
#include <array>
#include <utility>

#include "core/warp_graph.h"
#include "deform/graph/node_reach.h"

namespace softscope {

/// The nearest of a cell's nodes, by number, weighted by docs/energy.md (25).
struct Carriers {
  NodeStencil stencil{};
  std::array<float, kNodesPerPoint> weights{};
};

/// Finds the carriers of one point after the other, fastest where those of one cell follow each
/// other. What it finds does not depend on the order.
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
