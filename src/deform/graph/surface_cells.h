// src/deform/graph/surface_cells.h: voxel grid of the model surface, for geodesic distances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "deform/graph/cell_numbering.h"
#include "deform/graph/surface_region.h"

namespace softscope {

/// Cubes that contain points; cubes that touch (also at a corner) are neighbours.
class SurfaceCells {
 public:
  /// Of the points inside of the region.
  SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm, double cell_mm,
               const SurfaceRegion& region);
  /// Of all points.
  SurfaceCells(const std::vector<Eigen::Vector3f>& positions_mm, double cell_mm)
      : SurfaceCells(positions_mm, cell_mm, SurfaceRegion(cell_mm)) {}

  int size() const { return table_.size(); }
  double cellMm() const { return cell_mm_; }
  /// Cell at a position; -1 if none.
  int cellAt(const Eigen::Vector3f& position_mm) const;
  /// Cell at, or next to, a position; -1 if none.
  int cellNear(const Eigen::Vector3f& position_mm) const;
  const Eigen::Vector3f& centre(int cell) const { return centres_[cell]; }
  /// visit(number) for the points of a cell, ascending.
  template <class Visit>
  void visitPoints(int cell, const Visit& visit) const {
    for (int at = first_[cell]; at < first_[cell + 1]; ++at) visit(points_[at]);
  }
  /// The model point closest to the cell's centre.
  int representative(int cell) const { return representatives_[cell]; }
  struct Neighbours {
    int count = 0;
    std::array<int, 26> cells;  // the first `count`
  };
  const Neighbours& neighbours(int cell) const { return neighbours_[cell]; }

 private:
  void sortPoints(const std::vector<Eigen::Vector3f>& positions_mm, const SurfaceRegion& region);
  void findCentres(const std::vector<Eigen::Vector3f>& positions_mm);
  void findNeighbours();

  double cell_mm_;
  CellNumbering table_;
  std::vector<int> points_;  // by their cell, in each ascending
  std::vector<int> first_;   // of each cell into points_, and the end
  std::vector<Eigen::Vector3f> centres_;
  std::vector<int> representatives_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace softscope
