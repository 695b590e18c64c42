// src/deform/graph/shape_memory.h: mean shape of the graph's edges over the last frames.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/kernels/edge_system.h"

namespace softscope {

/// Takes the live shape into the mean of each edge: docs/energy.md (6b). Call it after a warp was
/// accepted: positions are live, `turned` holds the warp's rotation.
void rememberShape(WarpGraph* graph);

/// Copies what edges with the same nodes remember. Both ascend by (first, second).
void keepMemory(const std::vector<GraphEdge>& from, std::vector<GraphEdge>* to);

/// docs/energy.md (6a). Sets where the nodes of each edge expect each other: `memory` (0 to 1) is
/// the share of the remembered offset, the rest is the present offset.
void expectShape(const WarpGraph& graph, double memory, std::vector<ExpectedOffsets>* expected);

}  // namespace softscope
