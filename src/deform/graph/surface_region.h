// src/deform/graph/surface_region.h: part of the model's surface in which its graph may change.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "deform/graph/cell_numbering.h"

namespace softscope {

/// Whole blocks of cells around points.
class SurfaceRegion {
 public:
  /// Everywhere.
  explicit SurfaceRegion(double cell_mm) : cells_(cell_mm), blocks_(cell_mm) {}
  /// Within `reach_mm` of these points at least.
  SurfaceRegion(const std::vector<Eigen::Vector3f>& positions_mm, const std::vector<int>& points,
                double reach_mm, double cell_mm);

  bool contains(const Eigen::Vector3f& position_mm) const {
    Cube cube;
    return mayContain(position_mm) && cells_.cubeOf(position_mm, &cube) && contains(blockOf(cube));
  }
  /// A fast test: most of a large model is outside.
  bool mayContain(const Eigen::Vector3f& position_mm) const {
    return is_everywhere_ || box_mm_.contains(position_mm);
  }
  bool contains(const Cube& block) const { return is_everywhere_ || blocks_.find(block) >= 0; }
  /// In blocks.
  static Cube blockOf(const Cube& cube) {
    constexpr int kBits = CellNumbering::kBlockBits;
    return {cube.x >> kBits, cube.y >> kBits, cube.z >> kBits};
  }

 private:
  CellNumbering cells_;         // none: their grid
  CellNumbering blocks_;        // of these cubes
  Eigen::AlignedBox3f box_mm_;  // of more than the blocks
  bool is_everywhere_ = true;
};

}  // namespace softscope
