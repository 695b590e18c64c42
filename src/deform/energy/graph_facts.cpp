#include "deform/energy/graph_facts.h"

#include <algorithm>
#include <numeric>

namespace softscope {

bool GraphStructure::sameAs(const WarpGraph& graph) const {
  return nodes_ == graph.size() && stencils_ == graph.stencils &&
         std::equal(edges_.begin(), edges_.end(), graph.edges.begin(), graph.edges.end(),
                    [](const GraphEdge& a, const GraphEdge& b) {
                      return a.first == b.first && a.second == b.second;
                    });
}

void GraphStructure::take(const WarpGraph& graph) {
  nodes_ = graph.size();
  stencils_ = graph.stencils;
  edges_ = graph.edges;
}

bool allFinite(const WarpGraph& graph) {
  for (std::size_t j = 0; j < graph.size(); ++j)
    if (!graph.positions_mm[j].allFinite() || !graph.transforms[j].linear.allFinite() ||
        !graph.transforms[j].translation_mm.allFinite())
      return false;
  return true;
}

double meanEdgeLength(const WarpGraph& graph) {
  double sum = 0;
  for (const GraphEdge& edge : graph.edges)
    sum += (graph.positions_mm[edge.first] - graph.positions_mm[edge.second]).norm();
  return graph.edges.empty() ? 1.0 : sum / static_cast<double>(graph.edges.size());
}

std::vector<char> nodesWithData(const WarpGraph& graph, const ConstraintSet& constraints) {
  std::vector<char> pulled(graph.size(), 0);
  for (const int s : constraints.active)
    for (const int node : graph.stencils[s]) pulled[node] = 1;
  return pulled;
}

int countIdleComponents(const WarpGraph& graph, const std::vector<char>& pulled) {
  std::vector<int> parent(graph.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const GraphEdge& edge : graph.edges) parent[find(edge.first)] = find(edge.second);
  std::vector<char> root_pulled(graph.size(), 0);
  const int nodes = static_cast<int>(graph.size());
  for (int j = 0; j < nodes; ++j)
    if (pulled[j]) root_pulled[find(j)] = 1;
  int idle = 0;
  for (int j = 0; j < nodes; ++j) idle += find(j) == j && !root_pulled[j];
  return idle;
}

}  // namespace softscope
