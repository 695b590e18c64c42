#include "deform/graph/graph_edges.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "deform/graph/node_pairs.h"
#include "deform/kernels/node_terms.h"

namespace softscope {
namespace {

constexpr int kBridges = 3;  // three neighbours hold a part's rotation too

NodePairs sharedStencils(const WarpGraph& graph) {
  NodePairs pairs;
  pairs.reserve(graph.stencils.size() * 6);
  for (const NodeStencil& stencil : graph.stencils)
    for (int b = 1; b < kNodesPerPoint; ++b)
      for (int a = 0; a < b; ++a)
        if (stencil[a] != stencil[b]) pairs.emplace_back(stencil[a], stencil[b]);
  sortNodePairs(static_cast<int>(graph.size()), &pairs);
  return pairs;
}

/// Connected component of each node; components are numbered by their first node.
std::vector<int> findParts(std::size_t nodes, const NodePairs& pairs, int* part_count) {
  std::vector<int> parent(nodes);
  std::iota(parent.begin(), parent.end(), 0);
  const auto find = [&](int node) {
    while (parent[node] != node) node = parent[node] = parent[parent[node]];
    return node;
  };
  for (const auto& [a, b] : pairs) {
    const int x = find(a), y = find(b);
    parent[std::max(x, y)] = std::min(x, y);
  }
  std::vector<int> part(nodes, -1);
  *part_count = 0;
  for (int node = 0; node < static_cast<int>(nodes); ++node) {
    const int root = find(node);
    if (part[root] < 0) part[root] = (*part_count)++;
    part[node] = part[root];
  }
  return part;
}

/// Node of part `own` closest to another part, with its distance order there.
void bridge(const WarpGraph& graph, const std::vector<int>& part, int own, NodePairs* pairs) {
  const int nodes = static_cast<int>(graph.size());
  const auto& g = graph.positions_mm;
  double closest = std::numeric_limits<double>::max();
  int from = -1;
  for (int i = 0; i < nodes; ++i) {
    if (part[i] != own) continue;
    for (int j = 0; j < nodes; ++j) {
      if (part[j] == own || (g[i] - g[j]).squaredNorm() >= closest) continue;
      closest = (g[i] - g[j]).squaredNorm();
      from = i;
    }
  }
  std::vector<std::pair<double, int>> others;
  for (int j = 0; j < nodes; ++j)
    if (part[j] != own) others.emplace_back((g[from] - g[j]).squaredNorm(), j);
  const std::size_t bridges = std::min<std::size_t>(kBridges, others.size());
  std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(bridges),
                    others.end());
  for (std::size_t i = 0; i < bridges; ++i)
    pairs->emplace_back(std::min(from, others[i].second), std::max(from, others[i].second));
}

/// Every component but the largest is connected to the closest one; repeated until one is left.
void joinParts(const WarpGraph& graph, NodePairs* pairs) {
  int count = 0;
  std::vector<int> part = findParts(graph.size(), *pairs, &count);
  while (count > 1) {
    std::vector<int> sizes(static_cast<std::size_t>(count), 0);
    for (const int p : part) ++sizes[p];
    const int largest =
        static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    for (int own = 0; own < count; ++own)
      if (own != largest) bridge(graph, part, own, pairs);
    part = findParts(graph.size(), *pairs, &count);
  }
}

}  // namespace

std::vector<GraphEdge> makeEdges(const WarpGraph& graph, const GraphOptions& options) {
  NodePairs pairs = sharedStencils(graph);
  joinParts(graph, &pairs);
  sortNodePairs(static_cast<int>(graph.size()), &pairs);
  std::vector<GraphEdge> edges;
  edges.reserve(pairs.size());
  for (const auto& [a, b] : pairs) {
    const double length_mm = (graph.positions_mm[a] - graph.positions_mm[b]).norm();
    edges.push_back({a, b, edgeWeight(length_mm, options.node_spacing_mm)});
  }
  return edges;
}

}  // namespace softscope
