// src/deform/energy/node_sight.h: visibility of nodes: stiffness of visible tissue, rest position
// of hidden tissue.
#pragma once

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/constraints.h"

namespace softscope {

/// docs/energy.md (7a), (7b). A point is visible if it is a candidate. Sets the
/// invisible share of each node, and the stiffness of each edge: 1 for nodes with
/// invisible points, down to `seen_stiffness` if all points of both nodes are visible.
void classifyNodes(const PointModel& model, const WarpGraph& graph,
                   const CandidatePoints& candidates, double seen_stiffness,
                   ConstraintSet* constraints);

}  // namespace softscope
