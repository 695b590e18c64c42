// src/deform/energy/graph_facts.h: structure and validity of a graph, before and after a solve.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/energy/constraints.h"

namespace softscope {

/// Structure that the symbolic part depends on.
class GraphStructure {
 public:
  bool sameAs(const WarpGraph& graph) const;
  void take(const WarpGraph& graph);

 private:
  std::size_t nodes_ = 0;
  std::vector<NodeStencil> stencils_;
  std::vector<GraphEdge> edges_;
};

/// True if all positions and transforms are finite.
bool allFinite(const WarpGraph& graph);

/// mm; 1 without edges.
double meanEdgeLength(const WarpGraph& graph);

/// Per node, 1 if a point or a match constrains it.
std::vector<char> nodesWithData(const WarpGraph& graph, const ConstraintSet& constraints);

/// Connected components of the graph without a constrained node.
int countIdleComponents(const WarpGraph& graph, const std::vector<char>& pulled);

}  // namespace softscope
