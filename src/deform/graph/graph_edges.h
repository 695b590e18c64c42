// src/deform/graph/graph_edges.h: edges between neighbouring nodes, and their weights.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Edges between all nodes that share a stencil; a part of the graph that no stencil ties to the
/// rest gets edges from its node that is closest to the rest to the three closest there.
std::vector<GraphEdge> makeEdges(const WarpGraph& graph, const GraphOptions& options);

}  // namespace softscope
