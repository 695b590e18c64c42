// src/core/warp_graph.h: embedded deformation graph: nodes, edges and transforms of the warp.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/hd.h"
#include "core/point_model.h"

namespace softscope {

/// Affine transform of a node: docs/energy.md (1). A rotation in the rigid node model.
struct NodeTransform {
  Eigen::Matrix3d linear = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_mm = Eigen::Vector3d::Zero();
};

/// Warps a point by a single node: docs/energy.md (1). mm.
SOFTSCOPE_HD inline Eigen::Vector3d warpByNode(const NodeTransform& transform,
                                               const Eigen::Vector3d& node_mm,
                                               const Eigen::Vector3d& point_mm) {
  return transform.linear * (point_mm - node_mm) + node_mm + transform.translation_mm;
}

/// Edge between neighbouring nodes (regularisation term). first < second.
struct GraphEdge {
  std::int32_t first = 0;
  std::int32_t second = 0;
  double weight = 1;  // alpha of docs/energy.md (6)
};

/// Offset of the other node of an edge, mm, in the frame of the first and of
/// the second node: mean over the last frames, docs/energy.md (6b).
struct EdgeShape {
  Eigen::Vector3d from_first_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d from_second_mm = Eigen::Vector3d::Zero();
  double frames = 0;  // number of frames in the mean; 0: new edge
};

/// Nodes that carry a group of points: ascending ids. For fewer than
/// four nodes the last one is repeated (with weight zero in the points).
using NodeStencil = std::array<std::int32_t, kNodesPerPoint>;

/// In a part of a graph: has nodes outside of it, and carries no point in sight.
constexpr NodeStencil kOutsideStencil{-1, -1, -1, -1};

/// Embedded deformation graph. Its warp maps the last frame to the live one: after each
/// frame nodes are re-based, so that positions are live and transforms the identity.
struct WarpGraph {
  std::vector<Eigen::Vector3d> positions_mm;   // of the nodes, in the world frame, before the warp
  std::vector<NodeTransform> transforms;       // one per node
  std::vector<NodeTransform> since_reference;  // motion since the reference shape, world
  std::vector<Eigen::Matrix3d> turned;         // rotation since creation, world from node
  std::vector<GraphEdge> edges;                // ascending by (first, second)
  std::vector<EdgeShape> edge_shapes;          // one per edge; those beyond its end are new
  std::vector<NodeStencil> stencils;           // indexed by PointBinding::stencil
  /// Nodes that share inactive points (pipeline/model/active_region.h): each pair once, ascending.
  std::vector<std::pair<std::int32_t, std::int32_t>> inactive_pairs;
  /// 1: so far from visible tissue that the node follows others (deform/solver/local_solver.h).
  /// Nodes beyond its end: 0.
  std::vector<std::uint8_t> afar;

  std::size_t size() const { return positions_mm.size(); }
  bool empty() const { return positions_mm.empty(); }
};

/// Where tissue that is now at `point_mm` was before the node made `motion` and arrived at
/// `node_mm`: the inverse of warpByNode(). `motion.linear` is a rotation. mm.
inline Eigen::Vector3d beforeMotion(const NodeTransform& motion, const Eigen::Vector3d& node_mm,
                                    const Eigen::Vector3d& point_mm) {
  return motion.linear.transpose() * (point_mm - node_mm) + node_mm - motion.translation_mm;
}

/// Position of a bound point in the reference shape: docs/energy.md (30).
/// An unbound point is where it was. World, mm.
inline Eigen::Vector3d referencePosition(const WarpGraph& graph, const PointBinding& binding,
                                         const Eigen::Vector3d& point_mm) {
  if (!binding.bound() || graph.since_reference.size() != graph.size()) return point_mm;
  const NodeStencil& stencil = graph.stencils[static_cast<std::size_t>(binding.stencil)];
  Eigen::Vector3d moved_mm = Eigen::Vector3d::Zero();
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const std::size_t node = static_cast<std::size_t>(stencil[k]);
    moved_mm +=
        static_cast<double>(binding.weights[k]) *
        (point_mm - beforeMotion(graph.since_reference[node], graph.positions_mm[node], point_mm));
  }
  return point_mm - moved_mm;
}

/// Number of different nodes of a stencil.
inline int distinctNodes(const NodeStencil& stencil) {
  if (stencil == kOutsideStencil) return 0;
  int count = 1;
  while (count < kNodesPerPoint && stencil[count] != stencil[count - 1]) ++count;
  return count;
}

}  // namespace softscope
