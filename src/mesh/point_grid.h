// src/mesh/point_grid.h: which points lie around a place.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace softscope {

/// Points sorted into cubes. Finite points only; in the order of their places in the input within a
/// cube, so that whoever walks through them meets the same ones first every time.
class PointGrid {
 public:
  PointGrid(const std::vector<Eigen::Vector3f>& points_mm, float cell_mm);

  /// Calls visit(point) for every point in the cubes that touch the ball, and some beyond it.
  template <class Visit>
  void visitAround(const Eigen::Vector3f& centre_mm, float radius_mm, const Visit& visit) const {
    const Eigen::Vector3i low = cellOf(centre_mm.array() - radius_mm);
    const Eigen::Vector3i high = cellOf(centre_mm.array() + radius_mm);
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y) visitRow(keyOf({low.x(), y, z}), high.x(), visit);
  }

 private:
  Eigen::Vector3i cellOf(const Eigen::Vector3f& point_mm) const {
    const Eigen::Array3f place = (point_mm - low_mm_).array() / cell_mm_;
    return place.floor().max(0.0f).min(float(kMostCells - 1)).cast<int>().matrix();
  }
  static std::uint64_t keyOf(const Eigen::Vector3i& cell) {
    return std::uint64_t(cell.z()) << 40 | std::uint64_t(cell.y()) << 20 | std::uint64_t(cell.x());
  }
  template <class Visit>
  void visitRow(std::uint64_t first_key, int last_x, const Visit& visit) const {
    const std::uint64_t last_key = (first_key & ~std::uint64_t(kMostCells - 1)) | unsigned(last_x);
    auto i = std::size_t(std::lower_bound(keys_.begin(), keys_.end(), first_key) - keys_.begin());
    for (; i < keys_.size() && keys_[i] <= last_key; ++i) visit(order_[i]);
  }

  static constexpr int kMostCells = 1 << 20;  // along an axis
  Eigen::Vector3f low_mm_ = Eigen::Vector3f::Zero();
  float cell_mm_;
  std::vector<std::uint64_t> keys_;  // rising
  std::vector<std::int32_t> order_;  // the points, by key
};

}  // namespace softscope
