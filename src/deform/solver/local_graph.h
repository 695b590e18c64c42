// src/deform/solver/local_graph.h: the part of a large graph whose warp a frame can tell.
#pragma once

#include <cstdint>
#include <vector>

#include "core/warp_graph.h"
#include "deform/energy/graph_facts.h"

namespace softscope {

/// Neighbours of the nodes, by edges. nodes + 1 starts.
struct NodeNeighbours {
  std::vector<int> start;
  std::vector<std::int32_t> nodes;
};
NodeNeighbours neighboursOf(const WarpGraph& graph);

/// Distance of each node, along edges, from the nearest of those with `is_source` (one per node);
/// infinite beyond `most_mm`.
std::vector<double> distancesFrom(const std::vector<char>& is_source, const WarpGraph& graph,
                                  const NodeNeighbours& neighbours, double most_mm);

/// The nodes without `afar`, their edges, and all stencils, so that points keep their bindings:
/// kOutsideStencil in place of one with another node.
class LocalGraph {
 public:
  /// Copies what has changed since the last call. At least one node is not afar.
  void take(const WarpGraph& graph);
  WarpGraph& graph() { return graph_; }
  /// Does a part of returnTo() now; of the graph that was taken.
  void prepareReturn(const WarpGraph& graph);
  /// The transforms of the local nodes; the others move with their neighbours nearer to the local
  /// nodes, without their rotation, whose errors grow with the distance.
  void returnTo(WarpGraph* whole);
  /// neighboursOf(), kept for the structure of the graph that was taken. Valid until the next call.
  const NodeNeighbours& neighboursIn(const WarpGraph& graph);

 private:
  void takeStructure(const WarpGraph& graph, std::vector<std::uint8_t> afar);

  /// A node afar, and those that it follows: parents_[begin] to parents_[end - 1].
  struct Follower {
    std::int32_t node;
    int begin, end;
  };

  WarpGraph graph_;
  std::vector<std::int32_t> whole_of_local_;
  std::vector<Follower> followers_;  // behind those that they follow
  std::vector<std::int32_t> parents_;
  // Of the graph that was taken.
  std::vector<std::uint8_t> afar_;
  GraphStructure structure_;
  NodeNeighbours neighbours_;  // once they are asked for
  NodeNeighbours neighbours_of_another_;
  bool has_followers_ = false;
};

}  // namespace softscope
