#include "deform/node_sight.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

void addShares(const WarpGraph& graph, const PointBinding& binding, double each,
               std::vector<double>* sums) {
  const NodeStencil& nodes = graph.stencils[static_cast<std::size_t>(binding.stencil)];
  for (int k = 0; k < kNodesPerPoint; ++k)
    (*sums)[static_cast<std::size_t>(nodes[k])] += each * binding.weights[k];
}

/// Of the points that each node carries, the share that is hidden.
std::vector<double> hiddenShares(const PointModel& model, const WarpGraph& graph,
                                 const CandidatePoints& candidates) {
  std::vector<double> all(graph.size(), 0), seen(graph.size(), 0);
  // Neither needs the other.
  parallelInvoke(
      [&] {
        for (const PointBinding& binding : model.bindings)
          if (binding.bound()) addShares(graph, binding, 1, &all);
      },
      [&] {
        for (const PointBinding& binding : candidates.bindings)
          addShares(graph, binding, candidates.points_each, &seen);
      });
  std::vector<double> hidden(graph.size(), 1);
  for (std::size_t j = 0; j < hidden.size(); ++j)
    if (all[j] > 0) hidden[j] = std::max(1 - seen[j] / all[j], 0.0);
  return hidden;
}

}  // namespace

void judgeSight(const PointModel& model, const WarpGraph& graph, const CandidatePoints& candidates,
                double seen_stiffness, ConstraintSet* constraints) {
  constraints->hidden = hiddenShares(model, graph, candidates);
  const std::vector<double>& hidden = constraints->hidden;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double either = std::max(hidden[static_cast<std::size_t>(graph.edges[e].first)],
                                   hidden[static_cast<std::size_t>(graph.edges[e].second)]);
    constraints->stiffness[e] = seen_stiffness + (1 - seen_stiffness) * either;
  }
}

}  // namespace softscope
