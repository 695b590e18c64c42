// src/deform/graph/surface_cells.h: voxel grid of the model surface, for geodesic distances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "deform/graph/cell_numbering.h"

namespace softscope {

/// Cubes that contain points; cubes that touch (also at a corner) are neighbours.
class SurfaceCells {
 public:
  /// Points outside of the grid get cell -1.
  SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm, const std::vector<int>& points,
               double cell_mm);

  int size() const { return table_.size(); }
  double cellMm() const { return cell_mm_; }
  /// Cell of points[i].
  int cellOf(int i) const { return cell_of_[i]; }
  /// Cell at, or next to, a position; -1 if none.
  int cellNear(const Eigen::Vector3f& position_mm) const;
  const Eigen::Vector3f& centre(int cell) const { return centres_[cell]; }
  /// The model point closest to the cell's centre.
  int representative(int cell) const { return representatives_[cell]; }
  struct Neighbours {
    int count = 0;
    std::array<int, 26> cells;  // the first `count`
  };
  const Neighbours& neighbours(int cell) const { return neighbours_[cell]; }

 private:
  /// By their cell, in each as given.
  struct SortedPoints {
    std::vector<int> points;
    std::vector<int> first;  // into points; one per cell, and the end
  };

  SortedPoints sortByCell(const std::vector<Eigen::Vector3f>& positions_mm,
                          const std::vector<int>& points);
  void findCentres(const std::vector<Eigen::Vector3f>& positions_mm, const SortedPoints& sorted);
  void findNeighbours();

  double cell_mm_;
  CellNumbering table_;
  std::vector<int> cell_of_;
  std::vector<Eigen::Vector3f> centres_;
  std::vector<int> representatives_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace softscope
