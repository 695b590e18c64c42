// src/deform/kernels/edge_system.h: residuals and normal equations of one edge, for CPU and GPU.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "core/hd.h"
#include "core/warp_graph.h"
#include "deform/kernels/node_terms.h"

namespace softscope {

/// Expected offsets of the nodes of an edge before rotation, world, mm.
struct ExpectedOffsets {
  Eigen::Vector3d from_first_mm, from_second_mm;
};

/// Node data for the terms of its edges.
struct PlacedNode {
  Eigen::Vector3d rest_mm;
  NodeTransform transform;
};

inline PlacedNode placedNode(const WarpGraph& graph, int node) {
  const auto j = static_cast<std::size_t>(node);
  return {graph.positions_mm[j], graph.transforms[j]};
}

/// Sum of both squared residuals: docs/energy.md (6).
SOFTSCOPE_HD inline double edgeEnergy(const PlacedNode& first, const PlacedNode& second,
                                      const ExpectedOffsets& expected) {
  return edgeResidual(first.rest_mm, first.transform, second.rest_mm, second.transform,
                      expected.from_first_mm)
             .squaredNorm() +
         edgeResidual(second.rest_mm, second.transform, first.rest_mm, first.transform,
                      expected.from_second_mm)
             .squaredNorm();
}

/// Both directions of an edge: docs/energy.md (6), (22). Each node expects an offset of the other.
/// Adds to the blocks of own, (other, own) or its transposed, other, and to both gradients.
template <class Node>
struct EdgeSystem {
  static constexpr int kUnknowns = Node::kUnknowns;
  using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;
  using Gradient = Eigen::Matrix<double, kUnknowns, 1>;
  Block first, cross, second;  // cross: rows of second, columns of first
  Gradient first_gradient, second_gradient;

  SOFTSCOPE_HD EdgeSystem(const PlacedNode& a, const PlacedNode& b, const ExpectedOffsets& expected,
                          double weight) {
    first.setZero(), cross.setZero(), second.setZero();
    first_gradient.setZero(), second_gradient.setZero();
    addDirection(a, b, expected.from_first_mm, weight, &first, &first_gradient, &second,
                 &second_gradient, /*cross_transposed=*/false);
    addDirection(b, a, expected.from_second_mm, weight, &second, &second_gradient, &first,
                 &first_gradient, /*cross_transposed=*/true);
  }

 private:
  SOFTSCOPE_HD void addDirection(const PlacedNode& own, const PlacedNode& other,
                                 const Eigen::Vector3d& expected_mm, double weight,
                                 Block* own_block, Gradient* own_gradient, Block* other_block,
                                 Gradient* other_gradient, bool cross_transposed) {
    const Eigen::Vector3d residual =
        edgeResidual(own.rest_mm, own.transform, other.rest_mm, other.transform, expected_mm);
    const typename Node::Jacobian j = Node::leverJacobian(own.transform, expected_mm);
    own_block->noalias() += weight * j.transpose() * j;
    own_gradient->noalias() += weight * j.transpose() * residual;
    // The Jacobian of the other node is -I in its translation, zero elsewhere.
    other_block->template bottomRightCorner<3, 3>().diagonal().array() += weight;
    other_gradient->template tail<3>() -= weight * residual;
    if (cross_transposed)
      cross.template rightCols<3>() -= weight * j.transpose();
    else
      cross.template bottomRows<3>() -= weight * j;
  }
};

}  // namespace softscope
