// src/mesh/point_grid.cpp: one sort.
#include "mesh/point_grid.h"

#include <limits>
#include <numeric>

namespace softscope {

PointGrid::PointGrid(const std::vector<Eigen::Vector3f>& points_mm, float cell_mm)
    : cell_mm_(cell_mm) {
  if (points_mm.empty()) return;
  low_mm_.setConstant(std::numeric_limits<float>::max());
  for (const Eigen::Vector3f& p : points_mm) low_mm_ = low_mm_.cwiseMin(p);
  std::vector<std::uint64_t> keys;
  keys.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm) keys.push_back(keyOf(cellOf(p)));
  order_.resize(points_mm.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
    return keys[std::size_t(a)] < keys[std::size_t(b)];
  });
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const std::uint64_t key = keys[std::size_t(order_[i])];
    if (!keys_.empty() && keys_.back() == key) continue;
    keys_.push_back(key);
    begins_.push_back(i);
  }
  begins_.push_back(order_.size());
}

}  // namespace softscope
