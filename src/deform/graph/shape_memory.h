// src/deform/graph/shape_memory.h: mean shape of the edges over the last frames.
#pragma once

#include <vector>

#include "core/warp_graph.h"
#include "deform/kernels/edge_system.h"

namespace softscope {

/// Adds the live shape to the mean of each edge: docs/energy.md (6b). Call it after
/// a warp was accepted: positions are live, `turned` is the rotation of the warp.
void updateShapeMemory(WarpGraph* graph);

/// Of each edge, the mean shape of the known one with the same nodes. Both ascend by
/// (first, second).
std::vector<EdgeShape> edgeShapesOf(const std::vector<GraphEdge>& edges,
                                    const std::vector<GraphEdge>& known,
                                    const std::vector<EdgeShape>& known_shapes);

/// docs/energy.md (6a). Sets the expected offset of the nodes of each edge: `memory`
/// (0 to 1) is the share of the mean offset, the rest is the present offset.
void expectShape(const WarpGraph& graph, double memory, std::vector<ExpectedOffsets>* expected);

}  // namespace softscope
