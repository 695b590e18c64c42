// src/deform/graph/graph_builder.h: nodes placed over the model, and binding of points to them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Result of the growth of the graph.
struct GraphGrowth {
  int nodes_added = 0;
  int points_bound = 0;            // for the first time
  int points_rebound = 0;          // because of a closer new node
  bool structure_changed = false;  // nodes, edges or stencils
};

/// Ascending.
std::vector<int> unboundPoints(const std::vector<PointBinding>& bindings);

/// Adds nodes for unbound points without a node within the spacing along the
/// surface, binds those points to their four nearest nodes along the surface
/// (docs/energy.md (25)), rebinds points close to a new node, and updates the
/// edges. Nodes keep their numbers. Fast if every point is bound. Points that are
/// not finite remain unbound. "Along the surface": the model is divided into cells,
/// and a node reaches the cells of a short path through touching cells; so nodes do
/// not carry points across a depth discontinuity. Parts without a connecting
/// surface are joined by edges, so that invisible parts follow the others. Must be
/// called between frames, when the transforms are the identity (after rebase()).
GraphGrowth growGraph(const GraphOptions& options, PointModel* model, WarpGraph* graph);
/// The same for the positions and bindings of a model, one per point.
GraphGrowth growGraph(const GraphOptions& options, const std::vector<Eigen::Vector3f>& positions_mm,
                      std::vector<PointBinding>* bindings, WarpGraph* graph);

/// After growth: the first nodes get these transforms, new nodes the motion of the nearest of them.
void followNeighbours(std::vector<NodeTransform> transforms, WarpGraph* graph);

}  // namespace softscope
