#include "deform/edge_stiffness.h"

#include <algorithm>

namespace softscope {
namespace {

void addShares(const WarpGraph& graph, const PointBinding& binding, double each,
               std::vector<double>* sums) {
  const NodeStencil& nodes = graph.stencils[static_cast<std::size_t>(binding.stencil)];
  for (int k = 0; k < kNodesPerPoint; ++k)
    (*sums)[static_cast<std::size_t>(nodes[k])] += each * binding.weights[k];
}

/// Of the points that each node carries, the share that is in sight.
std::vector<double> seenShares(const PointModel& model, const WarpGraph& graph,
                               const CandidatePoints& candidates) {
  std::vector<double> all(graph.size(), 0), seen(graph.size(), 0);
  for (const PointBinding& binding : model.bindings)
    if (binding.bound()) addShares(graph, binding, 1, &all);
  for (const PointBinding& binding : candidates.bindings)
    addShares(graph, binding, candidates.points_each, &seen);
  for (std::size_t j = 0; j < seen.size(); ++j)
    seen[j] = all[j] > 0 ? std::min(seen[j] / all[j], 1.0) : 0;
  return seen;
}

}  // namespace

void softenWhereSeen(const PointModel& model, const WarpGraph& graph,
                     const CandidatePoints& candidates, double seen_stiffness,
                     std::vector<double>* stiffness) {
  const std::vector<double> seen = seenShares(model, graph, candidates);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double both = std::min(seen[static_cast<std::size_t>(graph.edges[e].first)],
                                 seen[static_cast<std::size_t>(graph.edges[e].second)]);
    (*stiffness)[e] = 1 - (1 - seen_stiffness) * both;
  }
}

}  // namespace softscope
