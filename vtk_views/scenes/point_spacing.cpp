// vtk_views/scenes/point_spacing.cpp: count of occupied grid cells.
#include "vtk_views/scenes/point_spacing.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace softscope {
namespace {

constexpr double kDotOfSpacing = 1.7;

/// Index of a grid cell.
std::uint64_t cellOf(const Eigen::Vector3f& p, float cell_mm) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis)
    key = key << 21 |
          (static_cast<std::uint64_t>(std::lround(p[axis] / cell_mm) + (1 << 20)) & 0x1FFFFF);
  return key;
}

std::size_t cellsOf(const std::vector<Eigen::Vector3f>& points_mm, float cell_mm) {
  std::vector<std::uint64_t> cells;
  cells.reserve(points_mm.size());
  for (const Eigen::Vector3f& p : points_mm) cells.push_back(cellOf(p, cell_mm));
  std::sort(cells.begin(), cells.end());
  return static_cast<std::size_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
}

}  // namespace

double surfaceSpacingMm(const std::vector<Eigen::Vector3f>& points_mm) {
  if (points_mm.size() < 2) return 1;
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& p : points_mm) box.extend(p);
  const float cell_mm = std::max(box.sizes().maxCoeff() / 48, 1e-3f);
  const double a_cell = double(points_mm.size()) / double(cellsOf(points_mm, cell_mm));
  return std::max(cell_mm / std::sqrt(a_cell), 1e-3);
}

double dotSizeMm(const std::vector<Eigen::Vector3f>& points_mm) {
  return kDotOfSpacing * surfaceSpacingMm(points_mm);
}

}  // namespace softscope
