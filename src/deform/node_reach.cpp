#include "deform/node_reach.h"

#include <algorithm>
#include <utility>

namespace softscope {

NodeReach::NodeReach(const SurfaceCells& cells, const GraphOptions& options)
    : cells_(cells),
      options_(options),
      near_(static_cast<std::size_t>(cells.size())),
      visited_(static_cast<std::size_t>(cells.size()), 0) {}

std::vector<int> NodeReach::spread(int node, const Eigen::Vector3f& position_mm) {
  std::vector<int> entered;
  const int start = cells_.cellNear(position_mm);
  if (start < 0) return entered;
  ++walk_;
  visited_[start] = walk_;
  std::vector<int> ring{start}, next;
  const double reach_mm = reachMm(options_);
  for (int steps = 0; !ring.empty(); ++steps, ring.swap(next)) {
    next.clear();
    for (const int cell : ring) {
      const float straight_mm = (cells_.centre(cell) - position_mm).norm();
      if (straight_mm > reach_mm) continue;
      // On an even surface a walk takes about one step a cell of straight line, never many more.
      const bool direct = steps <= 2 + options_.kDetourRatio * straight_mm / cells_.cellMm();
      if (direct && enter(node, straight_mm, &near_[cell]) <= kNodesPerPoint)
        entered.push_back(cell);
      for (int i = cells_.neighboursBegin(cell); i < cells_.neighboursEnd(cell); ++i) {
        const int other = cells_.neighbour(i);
        if (visited_[other] == walk_) continue;
        visited_[other] = walk_;
        next.push_back(other);
      }
    }
  }
  return entered;
}

/// Insertion into a short sorted list; equal distances keep the lower node first. Returns where.
int NodeReach::enter(int node, float distance_mm, Near* near) const {
  int at = near->count;
  while (at > 0 && near->distance_mm[at - 1] > distance_mm) --at;
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
