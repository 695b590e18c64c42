#include "deform/graph/graph_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "core/parallel.h"
#include "deform/graph/node_pairs.h"
#include "deform/kernels/node_terms.h"

namespace softscope {
namespace {

constexpr int kBridges = 3;  // three neighbours hold a part's rotation too

/// Ascending; each pair once.
NodePairs sharedStencils(const WarpGraph& graph) {
  const std::size_t nodes = graph.size();
  std::vector<std::size_t> start(nodes + 1, 0);
  visitNodePairs(graph.stencils, [&](std::int32_t a, std::int32_t) { ++start[a + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::int32_t> seconds(start.back());
  std::vector<std::size_t> end(start.begin(), start.end() - 1);
  visitNodePairs(graph.stencils, [&](std::int32_t a, std::int32_t b) { seconds[end[a]++] = b; });

  NodePairs pairs;
  std::vector<std::int32_t> partners, last_first(nodes, -1);
  for (std::int32_t a = 0; a < static_cast<std::int32_t>(nodes); ++a) {
    partners.clear();
    for (std::size_t i = start[a]; i < end[a]; ++i)
      if (std::exchange(last_first[seconds[i]], a) != a) partners.push_back(seconds[i]);
    std::sort(partners.begin(), partners.end());
    for (const std::int32_t b : partners) pairs.emplace_back(a, b);
  }
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

/// Nodes in squares of their first two coordinates, a few in each.
class NodeSquares {
 public:
  explicit NodeSquares(const WarpGraph& graph);

  /// Then visitAround() passes over squares without nodes of other parts.
  void setParts(const std::vector<int>& part);

  /// Calls visit(other, squared distance) for nodes of other parts, outwards, while a square may
  /// hold nodes at most `farthest_mm2` away, which visit() may lower.
  template <class Visit>
  void visitAround(int node, const double& farthest_mm2, const Visit& visit) const {
    const int u = columnOf(node), v = rowOf(node);
    for (int ring = 0; ring <= side_; ++ring) {
      const double least_mm = std::max(0, ring - 1) * square_mm_;
      if (least_mm * least_mm > farthest_mm2) return;
      for (int y = std::max(v - ring, 0); y <= std::min(v + ring, side_ - 1); ++y) {
        const int step = std::abs(y - v) == ring ? 1 : 2 * ring;  // along the edge, or across
        for (int x = u - ring; x <= u + ring; x += step)
          if (x >= 0 && x < side_) visitSquare(squareAt(x, y), node, visit);
      }
    }
  }

 private:
  static constexpr int kEmpty = -1, kMixed = -2;

  template <class Visit>
  void visitSquare(std::size_t square, int node, const Visit& visit) const {
    const int there = part_of_square_[square], own = part_[node];
    if (there == own || there == kEmpty) return;
    for (int k = start_[square]; k < start_[square + 1]; ++k)
      if (part_[nodes_[k]] != own)
        visit(nodes_[k], (positions_mm_[node] - positions_mm_[nodes_[k]]).squaredNorm());
  }
  std::size_t squareAt(int x, int y) const { return static_cast<std::size_t>(y * side_ + x); }
  std::size_t squareOf(int node) const { return squareAt(columnOf(node), rowOf(node)); }
  int columnOf(int node) const { return placeOf(positions_mm_[node].x() - corner_mm_.x()); }
  int rowOf(int node) const { return placeOf(positions_mm_[node].y() - corner_mm_.y()); }
  int placeOf(double along_mm) const {
    const double place = along_mm / square_mm_;
    return place >= 0 && place < side_ ? static_cast<int>(place) : 0;
  }

  const std::vector<Eigen::Vector3d>& positions_mm_;
  Eigen::Vector2d corner_mm_;
  double square_mm_;
  int side_;                // squares in a row, and in a column
  std::vector<int> start_;  // per square, its first place in nodes_; side_ * side_ + 1
  std::vector<int> nodes_;
  std::vector<int> part_;            // per node
  std::vector<int> part_of_square_;  // of all nodes in it; or kEmpty, kMixed
};

NodeSquares::NodeSquares(const WarpGraph& graph) : positions_mm_(graph.positions_mm) {
  constexpr double kNodesPerSquare = 4;
  Eigen::AlignedBox2d box_mm;
  for (const Eigen::Vector3d& position_mm : positions_mm_) box_mm.extend(position_mm.head<2>());
  corner_mm_ = box_mm.min();
  side_ = static_cast<int>(std::ceil(std::sqrt(graph.size() / kNodesPerSquare)));
  // The farthest node is in the last square.
  square_mm_ = std::max(1e-6, 1.001 * box_mm.sizes().maxCoeff() / side_);
  start_.assign(static_cast<std::size_t>(side_ * side_) + 1, 0);
  const int nodes = static_cast<int>(graph.size());
  for (int j = 0; j < nodes; ++j) ++start_[squareOf(j) + 1];
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  nodes_.resize(graph.size());
  std::vector<int> next(start_.begin(), start_.end() - 1);
  for (int j = 0; j < nodes; ++j) nodes_[next[squareOf(j)]++] = j;
}

void NodeSquares::setParts(const std::vector<int>& part) {
  part_ = part;
  part_of_square_.assign(start_.size() - 1, kEmpty);
  for (std::size_t square = 0; square < part_of_square_.size(); ++square)
    for (int k = start_[square]; k < start_[square + 1]; ++k) {
      int& there = part_of_square_[square];
      there = there == kEmpty || there == part_[nodes_[k]] ? part_[nodes_[k]] : kMixed;
    }
}

/// The node of a part that is closest to another part, and the closest nodes of others to it.
/// `nodes`: of the part, ascending.
void bridge(const NodeSquares& squares, const std::vector<int>& nodes, NodePairs* pairs) {
  double closest_mm2 = std::numeric_limits<double>::max();
  int from = -1;
  for (const int i : nodes)
    squares.visitAround(i, closest_mm2, [&](int, double away_mm2) {
      if (away_mm2 >= closest_mm2) return;
      closest_mm2 = away_mm2;
      from = i;
    });
  std::vector<std::pair<double, int>> others;  // at most kBridges, ascending
  double farthest_mm2 = std::numeric_limits<double>::max();
  squares.visitAround(from, farthest_mm2, [&](int j, double away_mm2) {
    const std::pair<double, int> other(away_mm2, j);
    if (others.size() == kBridges && !(other < others.back())) return;
    if (others.size() == kBridges) others.pop_back();
    others.insert(std::upper_bound(others.begin(), others.end(), other), other);
    if (others.size() == kBridges) farthest_mm2 = others.back().first;
  });
  for (const auto& [away_mm2, other] : others)
    pairs->emplace_back(std::min(from, other), std::max(from, other));
}

/// Every component but the largest is connected to the closest one; repeated until one is left.
void joinParts(const WarpGraph& graph, NodePairs* pairs) {
  int count = 0;
  std::vector<int> part = findParts(graph.size(), *pairs, &count);
  if (count <= 1) return;
  NodeSquares squares(graph);
  while (count > 1) {
    std::vector<std::vector<int>> nodes_of(static_cast<std::size_t>(count));
    for (std::size_t j = 0; j < part.size(); ++j) nodes_of[part[j]].push_back(static_cast<int>(j));
    squares.setParts(part);
    const auto largest = std::max_element(
        nodes_of.begin(), nodes_of.end(),
        [](const auto& one, const auto& other) { return one.size() < other.size(); });
    for (auto nodes = nodes_of.begin(); nodes != nodes_of.end(); ++nodes)
      if (nodes != largest) bridge(squares, *nodes, pairs);
    part = findParts(graph.size(), *pairs, &count);
  }
}

}  // namespace

std::vector<GraphEdge> makeEdges(const WarpGraph& graph, const GraphOptions& options) {
  NodePairs pairs = sharedStencils(graph);
  if (!graph.inactive_pairs.empty()) {
    const NodePairs active = std::exchange(pairs, {});
    std::set_union(active.begin(), active.end(), graph.inactive_pairs.begin(),
                   graph.inactive_pairs.end(), std::back_inserter(pairs));
  }
  const auto bridges = static_cast<std::ptrdiff_t>(pairs.size());
  joinParts(graph, &pairs);
  std::sort(pairs.begin() + bridges, pairs.end());
  std::inplace_merge(pairs.begin(), pairs.begin() + bridges, pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  constexpr int kEdgesPerTask = 4096;
  std::vector<GraphEdge> edges(pairs.size());
  parallelRanges(static_cast<int>(pairs.size()), kEdgesPerTask, [&](int begin, int end) {
    for (int e = begin; e < end; ++e) {
      const auto& [a, b] = pairs[static_cast<std::size_t>(e)];
      const double length_mm = (graph.positions_mm[a] - graph.positions_mm[b]).norm();
      edges[static_cast<std::size_t>(e)] = {a, b, edgeWeight(length_mm, options.node_spacing_mm)};
    }
  });
  return edges;
}

}  // namespace softscope
