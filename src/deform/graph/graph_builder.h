// src/deform/graph/graph_builder.h: nodes placed over the model, and binding of points to them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// What growing the graph did.
struct GraphGrowth {
  int nodes_added = 0;
  int points_bound = 0;            // for the first time
  int points_rebound = 0;          // because a new node is closer than one they had
  bool structure_changed = false;  // nodes, edges or stencils
};

/// Puts nodes where the model has unbound points and no node within the spacing along the surface,
/// binds those points to their four nearest nodes along the surface (docs/energy.md (25)), rebinds
/// points that a new node is close to, and renews the edges. Nodes keep their numbers. Does next to
/// nothing where every point is bound. Points that are not finite stay unbound.
///
/// "Along the surface": the model is cut into cells, and a node reaches the cells that a short walk
/// through touching cells leads to; so nodes don't carry points across a gap in depth. Parts that
/// no surface connects are joined by edges alone, so that what is unseen follows the rest.
/// Call it between frames, when the transforms are the identity (after rebase()).
GraphGrowth growGraph(const GraphOptions& options, PointModel* model, WarpGraph* graph);
/// The same for a model's positions and bindings, one of each a point.
GraphGrowth growGraph(const GraphOptions& options, const std::vector<Eigen::Vector3f>& positions_mm,
                      std::vector<PointBinding>* bindings, WarpGraph* graph);

}  // namespace softscope
