#include "deform/energy/node_sight.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kNodesPerTask = 96;

/// Sums over bound points, per node. Every task visits
/// all points and adds those of its own nodes, in order.
std::vector<double> sumsOf(const std::vector<PointBinding>& bindings, const WarpGraph& graph,
                           double each) {
  std::vector<double> sums(graph.size(), 0);
  parallelRanges(static_cast<int>(sums.size()), kNodesPerTask, [&](int begin, int end) {
    for (const PointBinding& binding : bindings) {
      if (!binding.bound()) continue;
      const NodeStencil& nodes = graph.stencils[static_cast<std::size_t>(binding.stencil)];
      for (int k = 0; k < kNodesPerPoint; ++k)
        if (nodes[k] >= begin && nodes[k] < end)
          sums[static_cast<std::size_t>(nodes[k])] += each * binding.weights[k];
    }
  });
  return sums;
}

/// Per node, the invisible share of its points.
std::vector<double> hiddenShares(const PointModel& model, const WarpGraph& graph,
                                 const CandidatePoints& candidates) {
  std::vector<double> all, seen;
  // Independent.
  parallelInvoke([&] { all = sumsOf(model.bindings, graph, 1); },
                 [&] { seen = sumsOf(candidates.bindings, graph, candidates.points_each); });
  std::vector<double> hidden(graph.size(), 1);
  for (std::size_t j = 0; j < hidden.size(); ++j)
    if (all[j] > 0) hidden[j] = std::max(1 - seen[j] / all[j], 0.0);
  return hidden;
}

}  // namespace

void classifyNodes(const PointModel& model, const WarpGraph& graph,
                   const CandidatePoints& candidates, double seen_stiffness,
                   ConstraintSet* constraints) {
  constraints->hidden = hiddenShares(model, graph, candidates);
  const std::vector<double>& hidden = constraints->hidden;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double either = std::max(hidden[static_cast<std::size_t>(graph.edges[e].first)],
                                   hidden[static_cast<std::size_t>(graph.edges[e].second)]);
    constraints->stiffness[e] = seen_stiffness + (1 - seen_stiffness) * either;
  }
}

}  // namespace softscope
