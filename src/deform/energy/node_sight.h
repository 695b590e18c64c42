// src/deform/energy/node_sight.h: visibility of nodes: stiffness of visible tissue, rest position
// of hidden tissue.
#pragma once

#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/energy/constraints.h"

namespace softscope {

/// docs/energy.md (7a), (7b). A point is visible if it is a candidate. Sets the
/// invisible share of each node, and multiplies the stiffness of each edge: by 1 for nodes with
/// invisible points, down to `seen_stiffness` if all points of both nodes are visible.
void classifyNodes(const PointModel& model, const WarpGraph& graph,
                   const CandidatePoints& candidates, double seen_stiffness,
                   ConstraintSet* constraints);

/// Per node, the number of points that it carries, by their weights; a point counts as `each`.
std::vector<double> carriedPoints(const std::vector<PointBinding>& bindings, const WarpGraph& graph,
                                  double each);
/// classifyNodes(), from the carried points of the model and of its candidates.
void classifyNodes(const WarpGraph& graph, const std::vector<double>& all,
                   const std::vector<double>& seen, double seen_stiffness,
                   ConstraintSet* constraints);

}  // namespace softscope
