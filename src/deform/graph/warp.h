// src/deform/graph/warp.h: warping of points and normals from the last frame to the current one.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/point_model.h"
#include "core/warp_graph.h"
#include "deform/kernels/deform_kernels.h"

namespace softscope {

/// The nodes' transforms in the layout of the warping loops.
std::vector<PackedNode> packNodes(const WarpGraph& graph);

/// Warps `count` points and unit normals by docs/energy.md (2), (24). Unbound points stay.
void warpRange(const std::vector<PackedNode>& nodes, const std::vector<NodeStencil>& stencils,
               const PointBinding* bindings, const Eigen::Vector3f* positions_mm,
               const Eigen::Vector3f* normals, int count, Eigen::Vector3f* warped_mm,
               Eigen::Vector3f* warped_normals);

/// Warps all points and normals of the model in place, on all cores.
void warpModel(const WarpGraph& graph, PointModel* model);

/// One point, mm, by the binding that carries it: docs/energy.md (2). The slow, exact version of
/// warpRange(), for tracked points.
Eigen::Vector3d warpPoint(const WarpGraph& graph, const PointBinding& binding,
                          const Eigen::Vector3d& point_mm);

/// Nodes move to where they were warped and their transforms become the identity, so that the
/// next frame's warp starts from the live shape. Bindings stay: the tissue is the same. Edges
/// remember the shape (shape_memory.h).
void rebase(WarpGraph* graph);

}  // namespace softscope
