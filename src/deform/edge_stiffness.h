// src/deform/edge_stiffness.h: tissue in sight bends as it is seen to, hidden tissue keeps its
// shape.
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/constraints.h"

namespace softscope {

/// docs/energy.md (7a): sets the stiffness of each edge to 1 where a node's points are hidden, down
/// to `seen_stiffness` where all points of both nodes are candidates, so in sight.
void softenWhereSeen(const PointModel& model, const WarpGraph& graph,
                     const CandidatePoints& candidates, double seen_stiffness,
                     std::vector<double>* stiffness);

}  // namespace softscope
