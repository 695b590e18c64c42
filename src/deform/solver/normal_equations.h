// src/deform/solver/normal_equations.h: J^T W J and J^T W r, block by block: docs/energy.md (16).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/warp_graph.h"
#include "deform/cholesky/block_pattern.h"
#include "deform/cholesky/part_lists.h"
#include "deform/energy/constraints.h"
#include "deform/energy/energy.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// Every stencil, edge and node sums its small dense system; then every
/// block of the matrix gathers its parts in a fixed order. Both steps
/// are parallel, and the result is identical for any number of threads.
template <class Node>
class NormalEquations {
 public:
  static constexpr int kUnknowns = Node::kUnknowns;
  static constexpr int kBlock = kUnknowns * kUnknowns;

  /// Once per change of nodes, edges or stencils.
  void analyse(const WarpGraph& graph, const BlockPattern& pattern);

  /// At the transforms of the graph, with its residuals and weights in `value`.
  void assemble(const WarpGraph& graph, const ConstraintSet& constraints, const EnergyValue& value,
                const DeformOptions& options);

  /// Blocks of the pattern, column-major, contiguous.
  const std::vector<double>& blocks() const { return blocks_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }

  double largestDiagonal() const;
  /// step^T D step, D the block diagonal.
  double diagonalProduct(const Eigen::VectorXd& step) const;

 private:
  void assembleStencils(const WarpGraph& graph, const ConstraintSet& constraints,
                        const EnergyValue& value);
  void assembleEdges(const WarpGraph& graph, const ConstraintSet& constraints, double weight);
  void assembleRotations(const WarpGraph& graph, double weight);
  void gather(const ConstraintSet& constraints);
  void addRest(const WarpGraph& graph, const std::vector<double>& hidden, double weight);

  BlockPattern pattern_;
  int stencils_ = 0, edges_ = 0;
  PartLists parts_;
  std::vector<double> part_blocks_;     // of stencils (10 each), edges (3), nodes (1 if affine)
  std::vector<double> part_gradients_;  // of stencils (4 each), edges (2), nodes (1 if affine)
  std::vector<double> blocks_;
  Eigen::VectorXd gradient_;
};

}  // namespace softscope
