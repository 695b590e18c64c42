// src/deform/energy/graph_facts.h: structure and validity of a graph, before and after a solve.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/energy/constraints.h"

namespace softscope {

/// What the symbolic part depends on.
class GraphStructure {
 public:
  bool sameAs(const WarpGraph& graph) const;
  void take(const WarpGraph& graph);

 private:
  std::size_t nodes_ = 0;
  std::vector<NodeStencil> stencils_;
  std::vector<GraphEdge> edges_;
};

/// Whether every position and transform is a number.
bool allFinite(const WarpGraph& graph);

/// mm; 1 where there is no edge.
double meanEdgeLength(const WarpGraph& graph);

/// For each node, 1 where a point or a match pulls it.
std::vector<char> nodesWithData(const WarpGraph& graph, const ConstraintSet& constraints);

/// Connected parts of the graph without one pulled node.
int countIdleComponents(const WarpGraph& graph, const std::vector<char>& pulled);

}  // namespace softscope
