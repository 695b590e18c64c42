// src/deform/graph/warp.h: warping of points and normals from the last frame to the current one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {

/// Transforms of the nodes in the layout of the warping loops.
std::vector<PackedNode> packNodes(const WarpGraph& graph);

/// Warps `count` points and unit normals by docs/energy.md (2), (24). Unbound points are unchanged.
void warpRange(const std::vector<PackedNode>& nodes, const std::vector<NodeStencil>& stencils,
               const PointBinding* bindings, const Eigen::Vector3f* positions_mm,
               const Eigen::Vector3f* normals, int count, Eigen::Vector3f* warped_mm,
               Eigen::Vector3f* warped_normals);

/// Warps all points and normals of the model in place, in parallel.
void warpModel(const WarpGraph& graph, PointModel* model);
/// Gives the model the warped points and normals of those; its bindings are theirs.
void warpModel(const WarpGraph& graph, const std::vector<Eigen::Vector3f>& from_mm,
               const std::vector<Eigen::Vector3f>& from_normals, PointModel* model);

/// Warps one point, mm, by its skinning weights: docs/energy.md
/// (2). The slow, exact version of warpRange(), for tracked points.
Eigen::Vector3d warpPoint(const WarpGraph& graph, const PointBinding& binding,
                          const Eigen::Vector3d& point_mm);

/// Sets the nodes to their warped positions and their transforms to the
/// identity, so that the next warp starts from the live shape. Bindings
/// are unchanged. Edges update their mean shape (shape_memory.h).
void rebase(WarpGraph* graph);

}  // namespace softscope
