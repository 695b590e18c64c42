#include "deform/energy/node_sight.h"

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kNodesPerTask = 96;

}  // namespace

std::vector<double> carriedPoints(const std::vector<PointBinding>& bindings, const WarpGraph& graph,
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

void classifyNodes(const PointModel& model, const WarpGraph& graph,
                   const CandidatePoints& candidates, double seen_stiffness,
                   ConstraintSet* constraints) {
  std::vector<double> all, seen;
  // Independent.
  parallelInvoke([&] { all = carriedPoints(model.bindings, graph, 1); },
                 [&] { seen = carriedPoints(candidates.bindings, graph, candidates.points_each); });
  classifyNodes(graph, all, seen, seen_stiffness, constraints);
}

void classifyNodes(const WarpGraph& graph, const std::vector<double>& all,
                   const std::vector<double>& seen, double seen_stiffness,
                   ConstraintSet* constraints) {
  std::vector<double>& hidden = constraints->hidden;
  hidden.assign(graph.size(), 1);
  for (std::size_t j = 0; j < hidden.size(); ++j)
    if (all[j] > 0) hidden[j] = std::max(1 - seen[j] / all[j], 0.0);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const double either = std::max(hidden[static_cast<std::size_t>(graph.edges[e].first)],
                                   hidden[static_cast<std::size_t>(graph.edges[e].second)]);
    constraints->stiffness[e] *= seen_stiffness + (1 - seen_stiffness) * either;
  }
}

}  // namespace softscope
