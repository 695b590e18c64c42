// src/deform/graph/node_reach.h: nodes within a geodesic distance along the surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/point_model.h"
#include "deform/graph/surface_cells.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// For each listed cell, the closest nodes reachable along the surface.
class NodeReach {
 public:
  static constexpr int kNearest = 10;

  /// Nodes of one cell, closest to its centre first.
  struct Near {
    int count = 0;
    std::array<int, kNearest> nodes{};
    std::array<float, kNearest> distance_mm{};
  };

  NodeReach(const SurfaceCells& cells, const GraphOptions& options);

  /// Maximum distance of a point from its nodes, mm.
  static double reachMm(const GraphOptions& options) { return 2.5 * options.node_spacing_mm; }
  /// Distances are rounded: what is farther is surely not reached.
  static double surelyBeyondMm(const GraphOptions& options) { return 1.001 * reachMm(options); }

  /// Node with the start of its walk.
  struct Start {
    int node = 0;
    Eigen::Vector3f position_mm;
  };

  /// Lists these cells too: with the nodes that walked so far, and those that will.
  void list(const std::vector<int>& cells);
  /// Walks from each node over touching cells, and adds it to the lists of close nodes.
  void spreadAll(const std::vector<Start>& starts);
  /// The same for one node; the cells that it reaches are listed. Returns those
  /// where it is one of the nodes that determine the skinning weights.
  std::vector<int> spread(int node, const Eigen::Vector3f& position_mm);

  /// Of a listed cell.
  const Near& near(int cell) const { return near_[cell]; }
  /// True if a node is within the node spacing of the centre of the listed cell.
  bool covered(int cell) const;

 private:
  struct Reached {
    int cell = 0;
    float distance_mm = 0;
  };
  struct Walk {
    Start start;
    std::vector<Reached> reached;
  };
  /// Cells visited by the last walk, so that a walk needs no clearing.
  struct Visits {
    explicit Visits(int cells)
        : last_walk(static_cast<std::size_t>(cells), 0),
          ring(last_walk.size() + 1),
          next(last_walk.size() + 1) {}
    std::vector<int> last_walk, ring, next;
    int walk = 0;
  };

  std::vector<Reached> walk(const Eigen::Vector3f& position_mm, Visits* visits) const;
  /// Into the lists of those cells of the walk.
  void enterWalk(const Walk& walk, const std::vector<char>& is_entered);
  int enter(int node, float distance_mm, Near* near) const;

  const SurfaceCells& cells_;
  GraphOptions options_;
  std::vector<Walk> walks_;
  std::vector<char> is_listed_;
  std::vector<Near> near_;
  Visits visits_;
};

}  // namespace softscope
