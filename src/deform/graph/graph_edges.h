// src/deform/graph/graph_edges.h: edges between neighbouring nodes, and their weights.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Edges between all nodes that share a stencil; a component without a stencil to the
/// others gets edges from its closest node to the three closest nodes of the others.
std::vector<GraphEdge> makeEdges(const WarpGraph& graph, const GraphOptions& options);

}  // namespace softscope
