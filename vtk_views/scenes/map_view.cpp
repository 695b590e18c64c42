// vtk_views/scenes/map_view.cpp: axes, extents, spacing.
#include "vtk_views/scenes/map_view.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace softscope {
namespace {

constexpr double kStrayShare = 0.02;  // at each side
constexpr float kWider = 1.12f;

}  // namespace

Eigen::Matrix3f viewAxes(const ErrorMap& map) {
  Eigen::Matrix3f axes;
  axes.col(2) = -map.look.normalized();
  const Eigen::Vector3f right = map.up.cross(axes.col(2));
  axes.col(0) = right.norm() > 1e-4f ? right.normalized().eval() : axes.col(2).unitOrthogonal();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

Eigen::AlignedBox3f mostOfPoints(const ErrorMap& view, const std::vector<const ErrorMap*>& maps) {
  const Eigen::Matrix3f axes = viewAxes(view);
  std::vector<float> places[3];
  for (const ErrorMap* map : maps)
    for (const Eigen::Vector3f& p : map->surface.vertices_mm) {
      const Eigen::Vector3f q = axes.transpose() * p;
      for (int k = 0; k < 3; ++k) places[k].push_back(q[k]);
    }
  Eigen::AlignedBox3f box(Eigen::Vector3f::Zero().eval());
  if (places[0].empty()) return box;
  for (int k = 0; k < 3; ++k) {
    std::vector<float>& along = places[k];
    const auto stray = static_cast<std::ptrdiff_t>(kStrayShare * double(along.size()));
    std::nth_element(along.begin(), along.begin() + stray, along.end());
    const float low = along[static_cast<std::size_t>(stray)];
    std::nth_element(along.begin(), along.end() - 1 - stray, along.end());
    const float high = *(along.end() - 1 - stray);
    const float middle = (low + high) / 2, half = kWider * (high - low) / 2;
    box.min()[k] = middle - half;
    box.max()[k] = middle + half;
  }
  return box;
}

double pointSpacingMm(const ErrorMap& map) {
  const Eigen::Matrix3f axes = viewAxes(map);
  Eigen::AlignedBox2f box;
  std::vector<Eigen::Vector2f> flat;
  for (const Eigen::Vector3f& p : map.surface.vertices_mm) {
    flat.emplace_back((axes.transpose() * p).head<2>());
    box.extend(flat.back());
  }
  if (flat.size() < 2) return 1;
  const float cell = std::max(box.sizes().maxCoeff() / 64, 1e-4f);
  std::set<std::pair<int, int>> cells;
  for (const Eigen::Vector2f& p : flat)
    cells.emplace(int((p.x() - box.min().x()) / cell), int((p.y() - box.min().y()) / cell));
  return std::max(double(cell) * std::sqrt(double(cells.size()) / double(flat.size())), 1e-3);
}

}  // namespace softscope
