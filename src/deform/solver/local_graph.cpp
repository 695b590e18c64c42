#include "deform/solver/local_graph.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace softscope {
namespace {

/// Number of edges between each node and the nearest local one; -1 without a path. `reached`:
/// the nodes with one, ascending by it.
std::vector<int> stepsFrom(const std::vector<char>& is_local, const NodeNeighbours& neighbours,
                           std::vector<std::size_t>* reached) {
  std::vector<int> steps(is_local.size(), -1);
  std::vector<std::size_t>& front = *reached;
  front.clear();
  for (std::size_t j = 0; j < is_local.size(); ++j) {
    if (is_local[j] == 0) continue;
    steps[j] = 0;
    front.push_back(j);
  }
  for (std::size_t next = 0; next < front.size(); ++next) {
    const std::size_t j = front[next];
    for (int k = neighbours.start[j]; k < neighbours.start[j + 1]; ++k) {
      const std::size_t other =
          static_cast<std::size_t>(neighbours.nodes[static_cast<std::size_t>(k)]);
      if (steps[other] >= 0) continue;
      steps[other] = steps[j] + 1;
      front.push_back(other);
    }
  }
  return steps;
}

}  // namespace

NodeNeighbours neighboursOf(const WarpGraph& graph) {
  NodeNeighbours found;
  found.start.assign(graph.size() + 1, 0);
  for (const GraphEdge& edge : graph.edges) {
    ++found.start[static_cast<std::size_t>(edge.first) + 1];
    ++found.start[static_cast<std::size_t>(edge.second) + 1];
  }
  for (std::size_t j = 0; j < graph.size(); ++j) found.start[j + 1] += found.start[j];
  found.nodes.resize(2 * graph.edges.size());
  std::vector<int> next(found.start.begin(), found.start.end() - 1);
  for (const GraphEdge& edge : graph.edges) {
    found.nodes[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.first)]++)] =
        edge.second;
    found.nodes[static_cast<std::size_t>(next[static_cast<std::size_t>(edge.second)]++)] =
        edge.first;
  }
  return found;
}

std::vector<double> distancesFrom(const std::vector<char>& is_source, const WarpGraph& graph,
                                  const NodeNeighbours& neighbours, double most_mm) {
  using Reached = std::pair<double, std::int32_t>;
  std::vector<double> distances_mm(graph.size(), std::numeric_limits<double>::infinity());
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (std::size_t j = 0; j < graph.size(); ++j) {
    if (is_source[j] == 0) continue;
    distances_mm[j] = 0;
    front.push({0, static_cast<std::int32_t>(j)});
  }
  while (!front.empty()) {
    const auto [from_mm, node] = front.top();
    front.pop();
    const std::size_t j = static_cast<std::size_t>(node);
    if (from_mm > distances_mm[j]) continue;
    for (int k = neighbours.start[j]; k < neighbours.start[j + 1]; ++k) {
      const std::size_t other =
          static_cast<std::size_t>(neighbours.nodes[static_cast<std::size_t>(k)]);
      const double there_mm = from_mm + (graph.positions_mm[other] - graph.positions_mm[j]).norm();
      if (!(there_mm <= most_mm && there_mm < distances_mm[other])) continue;
      distances_mm[other] = there_mm;
      front.push({there_mm, static_cast<std::int32_t>(other)});
    }
  }
  return distances_mm;
}

void LocalGraph::take(const WarpGraph& graph) {
  std::vector<std::uint8_t> afar = graph.afar;
  afar.resize(graph.size(), 0);
  if (afar_ != afar || !structure_.sameAs(graph)) takeStructure(graph, std::move(afar));
  graph_.positions_mm.clear();
  graph_.transforms.clear();
  graph_.since_reference.clear();
  graph_.turned.clear();
  for (const std::int32_t node : whole_of_local_) {
    const std::size_t j = static_cast<std::size_t>(node);
    graph_.positions_mm.push_back(graph.positions_mm[j]);
    graph_.transforms.push_back(graph.transforms[j]);
    if (j < graph.since_reference.size())
      graph_.since_reference.push_back(graph.since_reference[j]);
    if (j < graph.turned.size()) graph_.turned.push_back(graph.turned[j]);
  }
  graph_.edge_shapes.resize(graph_.edges.size());
  std::size_t local = 0;
  for (const GraphEdge& edge : graph.edges) {
    if (afar_[static_cast<std::size_t>(edge.first)] | afar_[static_cast<std::size_t>(edge.second)])
      continue;
    graph_.edges[local].weight = edge.weight;
    const std::size_t e = static_cast<std::size_t>(&edge - graph.edges.data());
    graph_.edge_shapes[local++] = e < graph.edge_shapes.size() ? graph.edge_shapes[e] : EdgeShape();
  }
}

void LocalGraph::takeStructure(const WarpGraph& graph, std::vector<std::uint8_t> afar) {
  afar_ = std::move(afar);
  structure_.take(graph);
  whole_of_local_.clear();
  std::vector<std::int32_t> local_of_whole(graph.size(), -1);
  std::vector<char> is_local(graph.size()), is_border(graph.size());
  for (std::size_t j = 0; j < graph.size(); ++j) {
    is_local[j] = afar_[j] == 0;
    if (!is_local[j]) continue;
    local_of_whole[j] = static_cast<std::int32_t>(whole_of_local_.size());
    whole_of_local_.push_back(static_cast<std::int32_t>(j));
  }
  const auto isLocal = [&](std::int32_t node) { return is_local[static_cast<std::size_t>(node)]; };

  graph_.edges.clear();
  for (const GraphEdge& edge : graph.edges)
    if (isLocal(edge.first) && isLocal(edge.second))
      graph_.edges.push_back({local_of_whole[static_cast<std::size_t>(edge.first)],
                              local_of_whole[static_cast<std::size_t>(edge.second)]});
  graph_.stencils.clear();
  for (NodeStencil stencil : graph.stencils) {
    if (std::all_of(stencil.begin(), stencil.end(), isLocal))
      for (std::int32_t& node : stencil) node = local_of_whole[static_cast<std::size_t>(node)];
    else
      stencil = kOutsideStencil;
    graph_.stencils.push_back(stencil);
  }

  neighbours_ = {};
  has_followers_ = false;
}

const NodeNeighbours& LocalGraph::neighboursIn(const WarpGraph& graph) {
  if (!structure_.sameAs(graph)) return neighbours_of_another_ = neighboursOf(graph);
  if (neighbours_.start.empty()) neighbours_ = neighboursOf(graph);
  return neighbours_;
}

void LocalGraph::prepareReturn(const WarpGraph& graph) {
  if (std::exchange(has_followers_, true)) return;
  std::vector<char> is_local(graph.size());
  for (std::size_t j = 0; j < graph.size(); ++j) is_local[j] = afar_[j] == 0;
  followers_.clear();
  parents_.clear();
  const NodeNeighbours& neighbours = neighboursIn(graph);
  std::vector<std::size_t> reached;
  const std::vector<int> steps = stepsFrom(is_local, neighbours, &reached);
  for (const std::size_t j : reached) {
    if (steps[j] == 0) continue;
    Follower follower{static_cast<std::int32_t>(j), static_cast<int>(parents_.size()), 0};
    for (int k = neighbours.start[j]; k < neighbours.start[j + 1]; ++k) {
      const std::int32_t other = neighbours.nodes[static_cast<std::size_t>(k)];
      if (steps[static_cast<std::size_t>(other)] < steps[j]) parents_.push_back(other);
    }
    follower.end = static_cast<int>(parents_.size());
    followers_.push_back(follower);
  }
}

void LocalGraph::returnTo(WarpGraph* whole) {
  prepareReturn(*whole);
  for (std::size_t k = 0; k < whole_of_local_.size(); ++k)
    whole->transforms[static_cast<std::size_t>(whole_of_local_[k])] = graph_.transforms[k];
  for (const Follower& follower : followers_) {
    Eigen::Vector3d moved_mm = Eigen::Vector3d::Zero();
    for (int k = follower.begin; k < follower.end; ++k)
      moved_mm += whole->transforms[static_cast<std::size_t>(parents_[static_cast<std::size_t>(k)])]
                      .translation_mm;
    NodeTransform& transform = whole->transforms[static_cast<std::size_t>(follower.node)];
    transform = NodeTransform();
    transform.translation_mm = moved_mm / (follower.end - follower.begin);
  }
}

}  // namespace softscope
