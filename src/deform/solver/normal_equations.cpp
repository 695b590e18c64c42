#include "deform/solver/normal_equations.h"

#include <algorithm>

#include "core/parallel.h"
#include "deform/kernels/edge_system.h"
#include "deform/kernels/node_terms.h"

namespace softscope {
namespace {

constexpr bool hasRotationTerm(int unknowns) { return unknowns == 12; }

template <int kUnknowns>
using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;

}  // namespace

template <class Node>
void NormalEquations<Node>::analyse(const WarpGraph& graph, const BlockPattern& pattern) {
  pattern_ = pattern;
  stencils_ = static_cast<int>(graph.stencils.size());
  edges_ = static_cast<int>(graph.edges.size());
  parts_ = makePartLists(graph, pattern, hasRotationTerm(kUnknowns));
  part_blocks_.resize(static_cast<std::size_t>(parts_.block_parts) * kBlock);
  part_gradients_.resize(static_cast<std::size_t>(parts_.gradient_parts) * kUnknowns);
  blocks_.resize(static_cast<std::size_t>(pattern.blocks()) * kBlock);
  gradient_.resize(static_cast<Eigen::Index>(pattern.nodes()) * kUnknowns);
}

template <class Node>
void NormalEquations<Node>::assemble(const WarpGraph& graph, const ConstraintSet& constraints,
                                     const EnergyValue& value, const DeformOptions& options) {
  assembleStencils(graph, constraints, value);
  assembleEdges(graph, constraints, options.regularisation_weight);
  if constexpr (hasRotationTerm(kUnknowns)) assembleRotations(graph, options.rotation_weight);
  gather(constraints);
  addRest(graph, constraints.hidden, options.rest_weight);
}

template <class Node>
void NormalEquations<Node>::assembleStencils(const WarpGraph& graph,
                                             const ConstraintSet& constraints,
                                             const EnergyValue& value) {
  const DeformKernels& kernels = deformKernels();
  const auto kernel = kUnknowns == 6 ? kernels.assembleRigid : kernels.assembleAffine;
  parallelRanges(static_cast<int>(constraints.active.size()), 16, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const std::size_t s = static_cast<std::size_t>(constraints.active[i]);
      const StencilRows& at = constraints.stencils[s];
      kernel(gatherStencil(graph, graph.stencils[s]), constraints.rows.data() + at.first,
             value.residuals.data() + at.first, value.weights.data() + at.first, at.rows(),
             part_blocks_.data() + s * kStencilBlocks * kBlock,
             part_gradients_.data() + s * kNodesPerPoint * kUnknowns);
    }
  });
}

template <class Node>
void NormalEquations<Node>::assembleEdges(const WarpGraph& graph, const ConstraintSet& constraints,
                                          double weight) {
  const std::size_t first_block = static_cast<std::size_t>(stencils_) * kStencilBlocks;
  const std::size_t first_gradient = static_cast<std::size_t>(stencils_) * kNodesPerPoint;
  parallelRanges(edges_, 64, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) {
      const GraphEdge& edge = graph.edges[e];
      const EdgeSystem<Node> system(placedNode(graph, edge.first), placedNode(graph, edge.second),
                                    constraints.expected[e],
                                    weight * constraints.stiffness[e] * edge.weight);
      double* blocks = part_blocks_.data() + (first_block + e * std::size_t{kEdgeBlocks}) * kBlock;
      std::copy_n(system.first.data(), kBlock, blocks);
      std::copy_n(system.cross.data(), kBlock, blocks + kBlock);
      std::copy_n(system.second.data(), kBlock, blocks + 2 * kBlock);
      double* gradients =
          part_gradients_.data() + (first_gradient + e * std::size_t{2}) * kUnknowns;
      std::copy_n(system.first_gradient.data(), kUnknowns, gradients);
      std::copy_n(system.second_gradient.data(), kUnknowns, gradients + kUnknowns);
    }
  });
}

template <class Node>
void NormalEquations<Node>::assembleRotations(const WarpGraph& graph, double weight) {
  double* blocks =
      part_blocks_.data() +
      static_cast<std::size_t>(stencils_ * kStencilBlocks + edges_ * kEdgeBlocks) * kBlock;
  double* gradients = part_gradients_.data() +
                      static_cast<std::size_t>(stencils_ * kNodesPerPoint + edges_ * 2) * kUnknowns;
  for (const NodeTransform& transform : graph.transforms) {
    const Eigen::Matrix<double, 6, 12> j = rotationJacobian(transform.linear);
    Eigen::Map<Eigen::Matrix<double, 12, 12>> block(blocks);
    Eigen::Map<Eigen::Matrix<double, 12, 1>> gradient(gradients);
    block.noalias() = weight * j.transpose() * j;
    gradient.noalias() = weight * j.transpose() * rotationResidual(transform.linear);
    blocks += kBlock;
    gradients += kUnknowns;
  }
}

/// Parts of stencils without rows are outdated and skipped.
template <class Node>
void NormalEquations<Node>::gather(const ConstraintSet& constraints) {
  const auto sumParts = [&](const GatherList& list, int target, int per_stencil, int size,
                            const double* parts, double* out) {
    std::fill_n(out, size, 0.0);
    const int stencil_parts = stencils_ * per_stencil;
    for (int i = list.start[target]; i < list.start[target + 1]; ++i) {
      const int part = list.parts[i];
      if (part < stencil_parts && constraints.stencils[part / per_stencil].rows() == 0) continue;
      const double* source = parts + static_cast<std::size_t>(part) * size;
      for (int k = 0; k < size; ++k) out[k] += source[k];
    }
  };
  parallelRanges(pattern_.nodes(), 16, [&](int begin, int end) {
    for (int node = begin; node < end; ++node)
      sumParts(parts_.gradients, node, kNodesPerPoint, kUnknowns, part_gradients_.data(),
               gradient_.data() + static_cast<std::ptrdiff_t>(node) * kUnknowns);
    for (int b = pattern_.column_start[begin]; b < pattern_.column_start[end]; ++b)
      sumParts(parts_.blocks, b, kStencilBlocks, kBlock, part_blocks_.data(),
               blocks_.data() + static_cast<std::size_t>(b) * kBlock);
  });
}

/// (7b): only the blocks of the translations.
template <class Node>
void NormalEquations<Node>::addRest(const WarpGraph& graph, const std::vector<double>& hidden,
                                    double weight) {
  for (std::size_t j = 0; j < hidden.size(); ++j) {
    const double w = weight * hidden[j];
    double* data = blocks_.data() + static_cast<std::size_t>(pattern_.column_start[j]) * kBlock;
    Eigen::Map<Block<kUnknowns>> block(data);
    block.template bottomRightCorner<3, 3>().diagonal().array() += w;
    gradient_.template segment<3>(static_cast<Eigen::Index>(j + 1) * kUnknowns - 3) +=
        w * graph.transforms[j].translation_mm;
  }
}

template <class Node>
double NormalEquations<Node>::largestDiagonal() const {
  double largest = 0;
  for (int node = 0; node < pattern_.nodes(); ++node) {
    const double* block =
        blocks_.data() + static_cast<std::size_t>(pattern_.column_start[node]) * kBlock;
    for (int a = 0; a < kUnknowns; ++a) largest = std::max(largest, block[a * (kUnknowns + 1)]);
  }
  return largest;
}

template <class Node>
double NormalEquations<Node>::diagonalProduct(const Eigen::VectorXd& step) const {
  double sum = 0;
  for (int node = 0; node < pattern_.nodes(); ++node) {
    const Eigen::Map<const Block<kUnknowns>> block(
        blocks_.data() + static_cast<std::size_t>(pattern_.column_start[node]) * kBlock);
    const Eigen::Matrix<double, kUnknowns, 1> own = step.segment<kUnknowns>(node * kUnknowns);
    sum += own.dot(block * own);
  }
  return sum;
}

template class NormalEquations<RigidNode>;
template class NormalEquations<AffineNode>;

}  // namespace softscope
