#include "deform/energy/energy.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "deform/energy/robust_loss.h"
#include "deform/kernels/edge_system.h"
#include "deform/kernels/node_terms.h"

namespace softscope {
namespace {

constexpr int kStencilsPerChunk = 32;  // a fixed partition: sums are independent of the threads

struct ChunkSum {
  double data = 0;
  double correspondence = 0;
  double data_abs_mm = 0;
};

/// docs/energy.md (12): the three rows of a match share one robust weight.
double weighMatches(const PlaneConstraint* rows, const double* residuals, int matches,
                    const RobustOptions& robust, double* weights) {
  double cost = 0;
  for (int m = 0; m < matches; ++m) {
    const double base = rows[3 * m].weight;
    const RobustValue value = robustValue(robust, squaredMatch(residuals + 3 * m));
    cost += base * value.cost;
    for (int c = 0; c < 3; ++c) weights[3 * m + c] = base * value.weight;
  }
  return cost;
}

double weighPoints(const PlaneConstraint* rows, const double* residuals, int points,
                   const RobustOptions& robust, double* weights) {
  double cost = 0;
  for (int i = 0; i < points; ++i) {
    const RobustValue value = robustValue(robust, residuals[i] * residuals[i]);
    cost += rows[i].weight * value.cost;
    weights[i] = rows[i].weight * value.weight;
  }
  return cost;
}

ChunkSum evaluateStencil(const WarpGraph& graph, const ConstraintSet& constraints, int stencil,
                         const DeformOptions& options, EnergyValue* value) {
  const StencilRows& at = constraints.stencils[stencil];
  const PlaneConstraint* rows = constraints.rows.data() + at.first;
  double* residuals = value->residuals.data() + at.first;
  double* weights = value->weights.data() + at.first;
  deformKernels().residuals(gatherStencil(graph, graph.stencils[stencil]), rows, at.rows(),
                            residuals);
  ChunkSum sum;
  const int match_rows = 3 * at.matches;
  sum.correspondence =
      weighMatches(rows, residuals, at.matches, options.correspondence_robust, weights);
  sum.data = weighPoints(rows + match_rows, residuals + match_rows, at.points, options.data_robust,
                         weights + match_rows);
  for (int i = match_rows; i < at.rows(); ++i) sum.data_abs_mm += std::abs(residuals[i]);
  return sum;
}

void evaluateConstraints(const WarpGraph& graph, const ConstraintSet& constraints,
                         const DeformOptions& options, EnergyValue* value) {
  value->residuals.resize(constraints.rows.size());
  value->weights.resize(constraints.rows.size());
  const int active = static_cast<int>(constraints.active.size());
  const int chunks = (active + kStencilsPerChunk - 1) / kStencilsPerChunk;
  std::vector<ChunkSum> sums(static_cast<std::size_t>(chunks));
  parallelRanges(chunks, 1, [&](int begin, int end) {
    for (int i = begin * kStencilsPerChunk; i < std::min(end * kStencilsPerChunk, active); ++i) {
      const ChunkSum one =
          evaluateStencil(graph, constraints, constraints.active[i], options, value);
      ChunkSum& chunk = sums[i / kStencilsPerChunk];
      chunk.data += one.data;
      chunk.correspondence += one.correspondence;
      chunk.data_abs_mm += one.data_abs_mm;
    }
  });
  for (const ChunkSum& chunk : sums) {
    value->terms.data += chunk.data;
    value->terms.correspondence += chunk.correspondence;
    value->data_abs_sum_mm += chunk.data_abs_mm;
  }
}

double edgesEnergy(const WarpGraph& graph, const ConstraintSet& constraints) {
  double sum = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    sum += constraints.stiffness[e] * edge.weight *
           edgeEnergy(placedNode(graph, edge.first), placedNode(graph, edge.second),
                      constraints.expected[e]);
  }
  return sum;
}

double restEnergy(const WarpGraph& graph, const std::vector<double>& hidden) {
  double sum = 0;
  for (std::size_t j = 0; j < hidden.size(); ++j)
    sum += hidden[j] * graph.transforms[j].translation_mm.squaredNorm();
  return sum;
}

double rotationEnergy(const WarpGraph& graph) {
  double sum = 0;
  for (const NodeTransform& transform : graph.transforms)
    sum += rotationResidual(transform.linear).squaredNorm();
  return sum;
}

}  // namespace

StencilState gatherStencil(const WarpGraph& graph, const NodeStencil& stencil) {
  StencilState state;
  for (int k = 0; k < kNodesPerPoint; ++k) {
    const NodeTransform& transform = graph.transforms[stencil[k]];
    const Eigen::Vector3d& g = graph.positions_mm[stencil[k]];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) state.linear[3 * r + c][k] = transform.linear(r, c);
      state.rest[r][k] = g[r];
      state.moved[r][k] = g[r] + transform.translation_mm[r];
    }
  }
  return state;
}

void evaluateEnergy(const WarpGraph& graph, const ConstraintSet& constraints,
                    const DeformOptions& options, EnergyValue* value) {
  value->terms = EnergyTerms();
  value->data_abs_sum_mm = 0;
  evaluateConstraints(graph, constraints, options, value);
  value->terms.regularisation = options.regularisation_weight * edgesEnergy(graph, constraints);
  value->terms.rest = options.rest_weight * restEnergy(graph, constraints.hidden);
  if (options.node_model == NodeModel::kAffine)
    value->terms.rotation = options.rotation_weight * rotationEnergy(graph);
}

}  // namespace softscope
