// src/mesh/point_grid.h: grid of points for neighbour searches.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace softscope {

/// Points sorted into cubic cells. Finite points only; within a cell
/// in the order of the input, so that traversal is deterministic.
class PointGrid {
 public:
  PointGrid(const std::vector<Eigen::Vector3f>& points_mm, float cell_mm);

  /// Calls visit(point) for every point in the cells that meet the ball, and for some outside.
  template <class Visit>
  void visitAround(const Eigen::Vector3f& centre_mm, float radius_mm, const Visit& visit) const {
    visitCells(centre_mm, radius_mm, [&](std::size_t cell) {
      for (std::size_t i = begins_[cell]; i < begins_[cell + 1]; ++i) visit(order_[i]);
    });
  }

  /// Calls visit(cell) for the non-empty cells.
  template <class Visit>
  void visitCells(const Eigen::Vector3f& centre_mm, float radius_mm, const Visit& visit) const {
    const Eigen::Vector3i low = cellOf(centre_mm.array() - radius_mm);
    const Eigen::Vector3i high = cellOf(centre_mm.array() + radius_mm);
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y) {
        const std::uint64_t last = keyOf({high.x(), y, z});
        for (auto i = placeOf(keyOf({low.x(), y, z})); i < keys_.size() && keys_[i] <= last; ++i)
          visit(i);
      }
  }

  std::size_t cellCount() const { return keys_.size(); }
  /// Cell of a point of the grid.
  std::size_t cellAt(const Eigen::Vector3f& point_mm) const {
    return placeOf(keyOf(cellOf(point_mm)));
  }

 private:
  Eigen::Vector3i cellOf(const Eigen::Vector3f& point_mm) const {
    const Eigen::Array3f place = (point_mm - low_mm_).array() / cell_mm_;
    return place.floor().max(0.0f).min(float(kMostCells - 1)).cast<int>().matrix();
  }
  static std::uint64_t keyOf(const Eigen::Vector3i& cell) {
    return std::uint64_t(cell.z()) << 40 | std::uint64_t(cell.y()) << 20 | std::uint64_t(cell.x());
  }
  /// Index of the first cell with at least this key.
  std::size_t placeOf(std::uint64_t key) const {
    return std::size_t(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
  }

  static constexpr int kMostCells = 1 << 20;  // per axis
  Eigen::Vector3f low_mm_ = Eigen::Vector3f::Zero();
  float cell_mm_;
  std::vector<std::uint64_t> keys_;  // of non-empty cells, ascending
  std::vector<std::size_t> begins_;  // first point of each cell in order_, and the total count
  std::vector<std::int32_t> order_;  // points sorted by cell
};

}  // namespace softscope
