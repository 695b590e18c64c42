// src/mesh/growing_surface.cpp: angular sectors around each point decide whether a triangle fits.
#include "mesh/growing_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace softscope {
namespace {

constexpr double kFullTurn = 2 * 3.14159265358979323846;
constexpr float kRoughCosine = 0.1f;  // steeper triangles do not fill holes

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// True if p is between two directions, less than half a turn apart.
bool within(const Eigen::Vector2d& p, const Eigen::Vector2d& first, const Eigen::Vector2d& last) {
  return cross(first, p) > 0 && cross(p, last) > 0;
}

/// Normal of length twice the area.
Eigen::Vector3f normalOf(const OrientedPoints& points, const Triangle& t) {
  const Eigen::Vector3f& a = points.positions_mm[std::size_t(t[0])];
  return (points.positions_mm[std::size_t(t[1])] - a)
      .cross(points.positions_mm[std::size_t(t[2])] - a);
}

}  // namespace

GrowingSurface::GrowingSurface(const OrientedPoints& points, float least_cosine)
    : points_(points), least_cosine_(least_cosine) {
  axes_.reserve(points.normals.size());
  for (const Eigen::Vector3f& normal : points.normals) axes_.emplace_back(normal);
  first_sector_.assign(points.normals.size(), -1);
  triangles_.reserve(2 * points.normals.size());
  sectors_.reserve(6 * points.normals.size());
}

bool GrowingSurface::faces(const Triangle& t) const {
  const Eigen::Vector3f normal = normalOf(points_, t);
  const float least = least_cosine_ * normal.norm();
  return std::all_of(t.begin(), t.end(), [&](std::int32_t point) {
    return normal.dot(points_.normals[std::size_t(point)]) > least;
  });
}

/// Compared with the mean of the point normals: tolerates noise at small holes.
bool GrowingSurface::facesRoughly(const Triangle& t) const {
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (const std::int32_t point : t) mean += points_.normals[std::size_t(point)];
  const Eigen::Vector3f normal = normalOf(points_, t);
  return normal.dot(mean) > kRoughCosine * normal.norm() * mean.norm() && mean.norm() > 1.5f;
}

bool GrowingSurface::hasRoom(std::int32_t point, std::int32_t from, std::int32_t to) const {
  const Eigen::Vector2d a = placeSeenFrom(point, from), b = placeSeenFrom(point, to);
  if (cross(a, b) <= 0) return false;  // back-facing from this point
  bool room = true;
  visitSectors(point, [&](std::int32_t, const Sector& sector) {
    room = room && sector.from != from && sector.to != to;  // else that side is occupied
    if (!room) return;
    const Eigen::Vector2d c = placeSeenFrom(point, sector.from);
    const Eigen::Vector2d d = placeSeenFrom(point, sector.to);
    if (sector.from != to && (within(c, a, b) || within(b, c, d))) room = false;
    if (sector.to != from && (within(d, a, b) || within(a, c, d))) room = false;
  });
  return room;
}

void GrowingSurface::take(const Triangle& t) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::int32_t& first = first_sector_[std::size_t(t[k])];
    sectors_.push_back({t[k], t[(k + 1) % 3], t[(k + 2) % 3], first});
    first = std::int32_t(sectors_.size()) - 1;
  }
  triangles_.push_back(t);
}

bool GrowingSurface::add(const Triangle& t) {
  if (!faces(t)) return false;
  for (std::size_t k = 0; k < 3; ++k)
    if (!hasRoom(t[k], t[(k + 1) % 3], t[(k + 2) % 3])) return false;
  take(t);
  return true;
}

bool GrowingSurface::connected(std::int32_t a, std::int32_t b) const {
  bool found = false;
  visitSectors(a, [&](std::int32_t, const Sector& sector) {
    found = found || sector.from == b || sector.to == b;
  });
  return found;
}

/// True if no triangle follows counter-clockwise at the point of the sector.
bool GrowingSurface::endsFan(const Sector& sector) const {
  bool last = true;
  visitSectors(sector.at,
               [&](std::int32_t, const Sector& other) { last = last && other.from != sector.to; });
  return last;
}

/// The border goes from the point of the sector to its `to`, then along the first gap clockwise.
std::int32_t GrowingSurface::nextAlongBorder(const Sector& sector) const {
  const Eigen::Vector2d back = placeSeenFrom(sector.to, sector.at);
  std::int32_t next = -1;
  double least_turn = 0;
  visitSectors(sector.to, [&](std::int32_t i, const Sector& other) {
    if (!endsFan(other)) return;
    const Eigen::Vector2d place = placeSeenFrom(sector.to, other.to);
    double turn = std::atan2(cross(place, back), place.dot(back));
    if (turn < 0) turn += kFullTurn;
    if (next >= 0 && turn >= least_turn) return;
    next = i;
    least_turn = turn;
  });
  return next;
}

std::vector<GrowingSurface::Loop> GrowingSurface::borders() const {
  std::vector<Loop> loops;
  std::vector<char> passed(sectors_.size(), 0);
  for (std::size_t first = 0; first < sectors_.size(); ++first) {
    if (passed[first] || !endsFan(sectors_[first])) continue;
    Loop loop;
    for (auto i = std::int32_t(first); i >= 0 && !passed[std::size_t(i)];
         i = nextAlongBorder(sectors_[std::size_t(i)])) {
      passed[std::size_t(i)] = 1;
      loop.push_back(sectors_[std::size_t(i)].at);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double GrowingSurface::lengthOf(const Loop& loop) const {
  double length_mm = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    length_mm += double((points_.positions_mm[std::size_t(loop[i])] -
                         points_.positions_mm[std::size_t(loop[(i + 1) % loop.size()])])
                            .norm());
  return length_mm;
}

/// Repeatedly cuts the corner whose triangle has the shortest new side.
void GrowingSurface::fill(Loop loop) {
  while (loop.size() >= 3) {
    std::size_t best = loop.size();
    float shortest_mm = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Triangle ear{loop[i], loop[(i + 1) % loop.size()], loop[(i + 2) % loop.size()]};
      const float side_mm =
          (points_.positions_mm[std::size_t(ear[0])] - points_.positions_mm[std::size_t(ear[2])])
              .norm();
      if (best < loop.size() && side_mm >= shortest_mm) continue;
      if (ear[0] == ear[2] || !facesRoughly(ear)) continue;
      if (loop.size() > 3 && connected(ear[0], ear[2])) continue;
      best = i;
      shortest_mm = side_mm;
    }
    if (best == loop.size()) return;
    const std::size_t tip = (best + 1) % loop.size();
    take({loop[best], loop[tip], loop[(best + 2) % loop.size()]});
    if (loop.size() == 3) return;
    loop.erase(loop.begin() + std::ptrdiff_t(tip));
  }
}

void GrowingSurface::closeHoles(double longest_mm) {
  for (Loop& loop : borders())
    if (loop.size() >= 3 && lengthOf(loop) <= longest_mm) fill(std::move(loop));
}

}  // namespace softscope
