#include "deform/graph/node_reach.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kWalksPerTask = 8;

}  // namespace

NodeReach::NodeReach(const SurfaceCells& cells, const GraphOptions& options)
    : cells_(cells),
      options_(options),
      is_listed_(static_cast<std::size_t>(cells.size()), false),
      near_(is_listed_.size()),
      visits_(cells.size()) {}

void NodeReach::list(const std::vector<int>& cells) {
  std::vector<int> added;
  for (const int cell : cells)
    if (!std::exchange(is_listed_[cell], true)) added.push_back(cell);
  if (added.empty() || walks_.empty()) return;
  std::vector<char> is_added(is_listed_.size(), false);
  Eigen::AlignedBox3f box_mm;
  for (const int cell : added) {
    is_added[cell] = true;
    box_mm.extend(cells_.centre(cell));
  }
  const auto beyond_mm = static_cast<float>(surelyBeyondMm(options_));
  for (const Walk& walk : walks_)
    if (box_mm.exteriorDistance(walk.start.position_mm) <= beyond_mm) enterWalk(walk, is_added);
}

/// Walks are independent.
void NodeReach::spreadAll(const std::vector<Start>& starts) {
  const std::size_t walked = walks_.size();
  walks_.resize(walked + starts.size());
  parallelRanges(static_cast<int>(starts.size()), kWalksPerTask, [&](int begin, int end) {
    Visits visits(cells_.size());
    for (int i = begin; i < end; ++i)
      walks_[walked + i] = {starts[i], walk(starts[i].position_mm, &visits)};
  });
  for (std::size_t i = walked; i < walks_.size(); ++i) enterWalk(walks_[i], is_listed_);
}

std::vector<int> NodeReach::spread(int node, const Eigen::Vector3f& position_mm) {
  Walk walk{{node, position_mm}, this->walk(position_mm, &visits_)};
  std::vector<int> cells;
  for (const Reached& reached : walk.reached) cells.push_back(reached.cell);
  list(cells);
  std::vector<int> entered;
  for (const Reached& reached : walk.reached)
    if (enter(node, reached.distance_mm, &near_[reached.cell]) <= kNodesPerPoint)
      entered.push_back(reached.cell);
  walks_.push_back(std::move(walk));
  return entered;
}

/// Ring by ring. Every cell is written as the next of the ring, and stays there if it is new:
/// without a branch, as most neighbours were visited already.
std::vector<NodeReach::Reached> NodeReach::walk(const Eigen::Vector3f& position_mm,
                                                Visits* visits) const {
  std::vector<Reached> reached;
  const int start = cells_.cellNear(position_mm);
  if (start < 0) return reached;
  int* const visited = visits->last_walk.data();
  const int walk = ++visits->walk;
  visited[start] = walk;
  int *ring = visits->ring.data(), *next = visits->next.data();
  ring[0] = start;
  int in_ring = 1;
  const float reach_mm = static_cast<float>(reachMm(options_));
  for (int steps = 0; in_ring > 0; ++steps, std::swap(ring, next)) {
    int in_next = 0;
    for (int i = 0; i < in_ring; ++i) {
      const int cell = ring[i];
      const float straight_mm = (cells_.centre(cell) - position_mm).norm();
      if (straight_mm > reach_mm) continue;
      // On an even surface a walk takes about one step per cell of straight line.
      if (steps <= 2 + options_.kDetourRatio * straight_mm / cells_.cellMm())
        reached.push_back({cell, straight_mm});
      const SurfaceCells::Neighbours& around = cells_.neighbours(cell);
      for (int k = 0; k < around.count; ++k) {
        const int other = around.cells[k];
        next[in_next] = other;
        in_next += visited[other] != walk;
        visited[other] = walk;
      }
    }
    in_ring = in_next;
  }
  return reached;
}

void NodeReach::enterWalk(const Walk& walk, const std::vector<char>& is_entered) {
  for (const Reached& reached : walk.reached)
    if (is_entered[reached.cell]) enter(walk.start.node, reached.distance_mm, &near_[reached.cell]);
}

/// Insertion into a short sorted list; of equal distances the lower node is first. Returns where.
int NodeReach::enter(int node, float distance_mm, Near* near) const {
  const auto isBefore = [&](int i) {
    return near->distance_mm[i] == distance_mm ? near->nodes[i] < node
                                               : near->distance_mm[i] < distance_mm;
  };
  int at = near->count;
  while (at > 0 && !isBefore(at - 1)) --at;
  if (at == kNearest) return at;
  near->count = std::min(near->count + 1, kNearest);
  for (int i = near->count - 1; i > at; --i) {
    near->nodes[i] = near->nodes[i - 1];
    near->distance_mm[i] = near->distance_mm[i - 1];
  }
  near->nodes[at] = node;
  near->distance_mm[at] = distance_mm;
  return at;
}

bool NodeReach::covered(int cell) const {
  const Near& near = near_[cell];
  return near.count > 0 && near.distance_mm[0] <= static_cast<float>(options_.node_spacing_mm);
}

}  // namespace softscope
