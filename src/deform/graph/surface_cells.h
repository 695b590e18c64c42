// src/deform/graph/surface_cells.h: voxel grid of the model surface, for geodesic distances.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace softscope {

/// A grain for loops over cells.
inline constexpr int kCellsPerTask = 512;

/// Grain of loops over cells in which each task visits all
/// data and handles its own part: at most one task per thread.
int cellsPerThread(int cells);

/// Numbers 0, 1, 2 … of cubes of a regular grid in order of first use.
class CellNumbering {
 public:
  explicit CellNumbering(double cell_mm, int expected_cells = 1024);

  /// False if the point is not finite, or outside of the grid (2^20 cells).
  bool keyOf(const Eigen::Vector3f& point_mm, std::uint64_t* key) const;
  /// Key of the cube at offset (dx, dy, dz).
  static std::uint64_t shifted(std::uint64_t key, int dx, int dy, int dz);

  int find(std::uint64_t key) const;  // -1 for a cube without a number
  int findOrAdd(std::uint64_t key);
  int size() const { return static_cast<int>(keys_.size()); }
  std::uint64_t key(int cell) const { return keys_[cell]; }

 private:
  std::size_t slotOf(std::uint64_t key) const;
  void grow();

  double inverse_cell_;
  std::vector<int> slots_;  // cell number, or -1
  std::vector<std::uint64_t> keys_;
};

/// Looks up points in sequence. Neighbours in the
/// list mostly share a cube, which is cached.
class CellFinder {
 public:
  explicit CellFinder(const CellNumbering& table) : table_(table) {}
  /// Cell of the point, -1 if none.
  int find(const Eigen::Vector3f& point_mm) {
    std::uint64_t key = 0;
    if (!table_.keyOf(point_mm, &key)) return -1;
    if (key != last_key_) last_cell_ = table_.find(key);
    last_key_ = key;
    return last_cell_;
  }

 private:
  const CellNumbering& table_;
  std::uint64_t last_key_ = ~std::uint64_t{0};  // no cube has it: keys take 63 bits
  int last_cell_ = -1;
};

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
  void numberCubes(const std::vector<Eigen::Vector3f>& positions_mm,
                   const std::vector<int>& points);
  void findCentres(const std::vector<Eigen::Vector3f>& positions_mm,
                   const std::vector<int>& points);
  void findNeighbours();

  double cell_mm_;
  CellNumbering table_;
  std::vector<int> cell_of_;
  std::vector<Eigen::Vector3f> centres_;
  std::vector<int> representatives_;
  std::vector<Neighbours> neighbours_;
};

}  // namespace softscope
