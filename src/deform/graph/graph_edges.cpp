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

/// Nodes by their first coordinate, so that a search for near ones ends early.
class NodesAlongX {
 public:
  explicit NodesAlongX(const WarpGraph& graph) : positions_mm_(graph.positions_mm) {
    order_.resize(graph.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int a, int b) { return x(a) < x(b); });
    place_.resize(graph.size());
    for (std::size_t k = 0; k < order_.size(); ++k)
      place_[static_cast<std::size_t>(order_[k])] = static_cast<std::ptrdiff_t>(k);
  }

  /// Calls visit(other, squared distance), outwards on both sides, while the first coordinate alone
  /// leaves the distance at most `farthest_mm2`, which visit() may lower.
  template <class Visit>
  void visitAround(int node, const double& farthest_mm2, const Visit& visit) const {
    for (const std::ptrdiff_t step : {-1, 1}) {
      const std::ptrdiff_t end = step < 0 ? -1 : static_cast<std::ptrdiff_t>(order_.size());
      for (std::ptrdiff_t k = place_[static_cast<std::size_t>(node)] + step; k != end; k += step) {
        const int other = order_[static_cast<std::size_t>(k)];
        const double along = x(other) - x(node);
        if (along * along > farthest_mm2) break;
        visit(other, (positions_mm_[static_cast<std::size_t>(node)] -
                      positions_mm_[static_cast<std::size_t>(other)])
                         .squaredNorm());
      }
    }
  }

 private:
  double x(int node) const { return positions_mm_[static_cast<std::size_t>(node)].x(); }

  const std::vector<Eigen::Vector3d>& positions_mm_;
  std::vector<int> order_;
  std::vector<std::ptrdiff_t> place_;
};

/// Node of part `own` closest to another part, with its distance order there.
void bridge(const WarpGraph& graph, const NodesAlongX& along, const std::vector<int>& part, int own,
            NodePairs* pairs) {
  const int nodes = static_cast<int>(graph.size());
  double closest_mm2 = std::numeric_limits<double>::max();
  int from = -1;
  for (int i = 0; i < nodes; ++i) {
    if (part[i] != own) continue;
    along.visitAround(i, closest_mm2, [&](int j, double away_mm2) {
      if (part[j] == own || away_mm2 >= closest_mm2) return;
      closest_mm2 = away_mm2;
      from = i;
    });
  }
  std::vector<std::pair<double, int>> others;
  for (int j = 0; j < nodes; ++j)
    if (part[j] != own)
      others.emplace_back((graph.positions_mm[from] - graph.positions_mm[j]).squaredNorm(), j);
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
  if (count <= 1) return;
  const NodesAlongX along(graph);
  while (count > 1) {
    std::vector<int> sizes(static_cast<std::size_t>(count), 0);
    for (const int p : part) ++sizes[p];
    const int largest =
        static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
    for (int own = 0; own < count; ++own)
      if (own != largest) bridge(graph, along, part, own, pairs);
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
