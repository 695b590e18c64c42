// src/deform/graph/node_reach.h: nodes within a geodesic distance along the surface.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "core/point_model.h"
#include "deform/graph/surface_cells.h"
#include "deform/options/deform_options.h"

namespace softscope {

/// For each cell, the closest nodes that can be reached along the surface.
class NodeReach {
 public:
  static constexpr int kNearest = 10;

  /// One cell's nodes, closest to its centre first.
  struct Near {
    int count = 0;
    std::array<int, kNearest> nodes{};
    std::array<float, kNearest> distance_mm{};
  };

  NodeReach(const SurfaceCells& cells, const GraphOptions& options);

  /// How far a node may carry points, mm.
  static double reachMm(const GraphOptions& options) { return 2.5 * options.node_spacing_mm; }

  /// A node, and where its walk begins.
  struct Start {
    int node = 0;
    Eigen::Vector3f position_mm;
  };

  /// spread() from each, in order, on all cores.
  void spreadAll(const std::vector<Start>& starts);
  /// Walks from the node over touching cells and enters it where it is among the closest.
  /// Returns the cells where it is one of the few that decide how a point is carried.
  std::vector<int> spread(int node, const Eigen::Vector3f& position_mm);

  const Near& near(int cell) const { return near_[cell]; }
  /// Whether some node lies within the node spacing of the cell's centre.
  bool covered(int cell) const;

 private:
  struct Reached {
    int cell = 0;
    float distance_mm = 0;
  };
  /// The cells that a walk visited last, so that each walk starts afresh without clearing.
  struct Visits {
    explicit Visits(int cells) : last_walk(static_cast<std::size_t>(cells), 0) {}
    std::vector<int> last_walk, ring, next;
    int walk = 0;
  };

  std::vector<Reached> walk(const Eigen::Vector3f& position_mm, Visits* visits) const;
  int enter(int node, float distance_mm, Near* near) const;

  const SurfaceCells& cells_;
  GraphOptions options_;
  std::vector<Near> near_;
  Visits visits_;
};

}  // namespace softscope
