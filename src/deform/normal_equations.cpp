#include "deform/normal_equations.h"

#include <algorithm>
#include <numeric>

#include "core/parallel.h"
#include "deform/node_terms.h"

namespace softscope {
namespace {

constexpr int kEdgeBlocks = 3;  // jj, kj, kk
constexpr bool hasRotationTerm(int unknowns) { return unknowns == 12; }

template <int kUnknowns>
using Block = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// One direction of an edge: docs/energy.md (6), (22). `own` expects `other` somewhere. Adds to
/// the blocks of own, (other, own) or its transposed, other, and to both gradients.
template <class Node>
struct EdgeSystem {
  static constexpr int kUnknowns = Node::kUnknowns;
  Block<kUnknowns> first, cross, second;  // cross: rows of second, columns of first
  Eigen::Matrix<double, kUnknowns, 1> first_gradient, second_gradient;

  EdgeSystem(const WarpGraph& graph, const GraphEdge& edge, const ExpectedOffsets& expected,
             double weight) {
    first.setZero(), cross.setZero(), second.setZero();
    first_gradient.setZero(), second_gradient.setZero();
    const double w = weight * edge.weight;
    addDirection(graph, edge.first, edge.second, expected.from_first_mm, w, &first, &first_gradient,
                 &second, &second_gradient, /*cross_transposed=*/false);
    addDirection(graph, edge.second, edge.first, expected.from_second_mm, w, &second,
                 &second_gradient, &first, &first_gradient, /*cross_transposed=*/true);
  }

 private:
  void addDirection(const WarpGraph& graph, int own, int other, const Eigen::Vector3d& expected_mm,
                    double weight, Block<kUnknowns>* own_block,
                    Eigen::Matrix<double, kUnknowns, 1>* own_gradient,
                    Block<kUnknowns>* other_block,
                    Eigen::Matrix<double, kUnknowns, 1>* other_gradient, bool cross_transposed) {
    const auto& g = graph.positions_mm;
    const auto& m = graph.transforms;
    const Eigen::Vector3d residual = edgeResidual(g[own], m[own], g[other], m[other], expected_mm);
    const typename Node::Jacobian j = Node::leverJacobian(m[own], expected_mm);
    own_block->noalias() += weight * j.transpose() * j;
    own_gradient->noalias() += weight * j.transpose() * residual;
    // The other node's Jacobian is -I in its translation, zero elsewhere.
    other_block->template bottomRightCorner<3, 3>().diagonal().array() += weight;
    other_gradient->template tail<3>() -= weight * residual;
    if (cross_transposed)
      cross.template rightCols<3>() -= weight * j.transpose();
    else
      cross.template bottomRows<3>() -= weight * j;
  }
};

}  // namespace

template <class Node>
typename NormalEquations<Node>::GatherList NormalEquations<Node>::makeList(
    int targets, const std::vector<std::pair<int, int>>& target_and_part) const {
  GatherList list;
  list.start.assign(static_cast<std::size_t>(targets) + 1, 0);
  for (const auto& [target, part] : target_and_part) ++list.start[target + 1];
  std::partial_sum(list.start.begin(), list.start.end(), list.start.begin());
  list.parts.resize(target_and_part.size());
  std::vector<int> next = list.start;
  for (const auto& [target, part] : target_and_part) list.parts[next[target]++] = part;
  return list;
}

template <class Node>
void NormalEquations<Node>::analyse(const WarpGraph& graph, const BlockPattern& pattern) {
  pattern_ = pattern;
  stencils_ = static_cast<int>(graph.stencils.size());
  edges_ = static_cast<int>(graph.edges.size());
  std::vector<std::pair<int, int>> blocks, gradients;
  int block_part = 0, gradient_part = 0;
  for (const NodeStencil& stencil : graph.stencils) {
    const int nodes = distinctNodes(stencil);
    for (int i = 0; i < kNodesPerPoint; ++i) {
      for (int j = i; j < kNodesPerPoint; ++j, ++block_part)
        if (j < nodes) blocks.emplace_back(pattern.find(stencil[j], stencil[i]), block_part);
      if (i < nodes) gradients.emplace_back(stencil[i], gradient_part);
      ++gradient_part;
    }
  }
  for (const GraphEdge& edge : graph.edges) {
    blocks.emplace_back(pattern.find(edge.first, edge.first), block_part++);
    blocks.emplace_back(pattern.find(edge.second, edge.first), block_part++);
    blocks.emplace_back(pattern.find(edge.second, edge.second), block_part++);
    gradients.emplace_back(edge.first, gradient_part++);
    gradients.emplace_back(edge.second, gradient_part++);
  }
  if (hasRotationTerm(kUnknowns))
    for (int node = 0; node < pattern.nodes(); ++node) {
      blocks.emplace_back(pattern.find(node, node), block_part++);
      gradients.emplace_back(node, gradient_part++);
    }
  block_parts_ = makeList(pattern.blocks(), blocks);
  gradient_parts_ = makeList(pattern.nodes(), gradients);
  part_blocks_.resize(static_cast<std::size_t>(block_part) * kBlock);
  part_gradients_.resize(static_cast<std::size_t>(gradient_part) * kUnknowns);
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
      const EdgeSystem<Node> system(graph, graph.edges[e], constraints.expected[e],
                                    weight * constraints.stiffness[e]);
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

/// Parts of stencils without rows hold old numbers and are left out.
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
      sumParts(gradient_parts_, node, kNodesPerPoint, kUnknowns, part_gradients_.data(),
               gradient_.data() + static_cast<std::ptrdiff_t>(node) * kUnknowns);
    for (int b = pattern_.column_start[begin]; b < pattern_.column_start[end]; ++b)
      sumParts(block_parts_, b, kStencilBlocks, kBlock, part_blocks_.data(),
               blocks_.data() + static_cast<std::size_t>(b) * kBlock);
  });
}

/// (7b): nothing but the translations' own blocks.
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
