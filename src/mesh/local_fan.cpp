// src/mesh/local_fan.cpp: Voronoi cell, clipped by one bisector after the other.
#include "mesh/local_fan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softscope {

bool NeighbourRule::join(const OrientedPoints& points, std::int32_t a, std::int32_t b) const {
  const Eigen::Vector3f& normal_a = points.normals[std::size_t(a)];
  const Eigen::Vector3f& normal_b = points.normals[std::size_t(b)];
  if (normal_a.dot(normal_b) < least_cosine) return false;
  const Eigen::Vector3f line =
      points.positions_mm[std::size_t(b)] - points.positions_mm[std::size_t(a)];
  // On an arc the chord is perpendicular to the mean of both normals, for any curvature.
  const float step = std::abs(line.dot((normal_a + normal_b).normalized()));
  return step <= std::max(noise_mm, most_step * line.norm());
}

PlaneAxes::PlaneAxes(const Eigen::Vector3f& normal) {
  u = normal.unitOrthogonal();
  v = normal.cross(u);
}

void LocalFan::gather(std::int32_t point, float reach) {
  const Eigen::Vector3f& centre = points_.positions_mm[std::size_t(point)];
  const PlaneAxes axes(points_.normals[std::size_t(point)]);
  neighbours_.clear();
  grid_.visitAround(centre, reach, [&](std::int32_t other) {
    const Eigen::Vector3f line = points_.positions_mm[std::size_t(other)] - centre;
    if (other == point || line.squaredNorm() > reach * reach || !rule_.join(points_, point, other))
      return;
    const Eigen::Vector2d place = axes.at(line);
    if (place.squaredNorm() > 0) neighbours_.push_back({other, place, place.squaredNorm()});
  });
  std::sort(neighbours_.begin(), neighbours_.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.squared_mm2 != b.squared_mm2 ? a.squared_mm2 < b.squared_mm2 : a.point < b.point;
  });
}

double LocalFan::reachOfCell() const {
  double squared = 0;
  for (const Corner& corner : cell_) squared = std::max(squared, corner.place_mm.squaredNorm());
  return 4 * squared;  // points beyond twice this radius do not clip
}

/// Clips the cell to the half plane nearer to the point than to the neighbour.
void LocalFan::cutBy(std::int32_t neighbour) {
  const Eigen::Vector2d& towards = neighbours_[std::size_t(neighbour)].place_mm;
  const double half = neighbours_[std::size_t(neighbour)].squared_mm2 / 2;
  cut_.clear();
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    const Corner& from = cell_[i];
    const Corner& to = cell_[(i + 1) % cell_.size()];
    const double beyond_from = from.place_mm.dot(towards) - half;
    const double beyond_to = to.place_mm.dot(towards) - half;
    if (beyond_from <= 0) cut_.push_back(from);
    if ((beyond_from <= 0) == (beyond_to <= 0)) continue;
    const double share = beyond_from / (beyond_from - beyond_to);
    const Eigen::Vector2d crossing = from.place_mm + share * (to.place_mm - from.place_mm);
    // The border leaves the kept side along the new bisector, and returns along the old one.
    cut_.push_back({crossing, beyond_from <= 0 ? neighbour : from.neighbour});
  }
  cell_.swap(cut_);
}

/// Clips by the neighbours within `reach_mm`, the nearest first.
/// Returns the radius within which neighbours may still clip.
double LocalFan::cutWithin(std::int32_t point, float reach_mm) {
  gather(point, reach_mm);
  const double r = rule_.hole_radius_mm;
  cell_ = {{{-r, -r}, -1}, {{r, -r}, -1}, {{r, r}, -1}, {{-r, r}, -1}};
  double reach = reachOfCell();
  for (std::size_t i = 0; i < neighbours_.size() && neighbours_[i].squared_mm2 < reach; ++i) {
    cutBy(std::int32_t(i));
    reach = reachOfCell();
  }
  return std::sqrt(reach);
}

const std::vector<FanTriangle>& LocalFan::around(std::int32_t point) {
  // In a dense surface the nearest neighbours are sufficient.
  const float reach_mm = 2 * rule_.hole_radius_mm;
  if (cutWithin(point, reach_mm / 2) > double(reach_mm) / 2) cutWithin(point, reach_mm);
  fan_.clear();
  for (std::size_t i = 0; i < cell_.size(); ++i) {
    // A corner is the intersection of two consecutive bisectors.
    const std::int32_t before = cell_[(i + cell_.size() - 1) % cell_.size()].neighbour;
    const std::int32_t after = cell_[i].neighbour;
    const double radius_mm = cell_[i].place_mm.norm();
    if (before < 0 || after < 0 || before == after || radius_mm > rule_.hole_radius_mm) continue;
    fan_.push_back({neighbours_[std::size_t(before)].point, neighbours_[std::size_t(after)].point,
                    float(radius_mm)});
  }
  return fan_;
}

}  // namespace softscope
