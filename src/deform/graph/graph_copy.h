// src/deform/graph/graph_copy.h: copies of a graph, large ones on all threads.
#pragma once

#include "core/warp_graph.h"

namespace softscope {

/// `to` keeps its memory where that is enough.
void copyGraph(const WarpGraph& from, WarpGraph* to);

/// What a solver's preparation reads: positions, edges, stencils, and which nodes are afar.
/// Transforms are the identity.
void copyStructure(const WarpGraph& from, WarpGraph* to);

}  // namespace softscope
