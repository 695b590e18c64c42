// src/mesh/growing_surface.h: incremental surface that stays manifold.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/local_fan.h"

namespace softscope {

/// Triangles between points, at most two per side, without overlap in the tangent plane
/// of each point: manifold (except for sheets that touch in a single point) and oriented.
class GrowingSurface {
 public:
  /// Keeps a reference to `points`. `least_cosine`: between normals of triangles and points.
  GrowingSurface(const OrientedPoints& points, float least_cosine);

  /// True if the triangle fits and was added.
  bool add(const Triangle& triangle);

  /// Fills holes with a border of at most `longest_mm`, as far as
  /// triangles are consistent with the mean normals of their points.
  void closeHoles(double longest_mm);

  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  /// Sector of a triangle at a point, from one other point to the next.
  struct Sector {
    std::int32_t at, from, to;
    std::int32_t next;  // sector of the same point; -1: the last
  };
  using Loop = std::vector<std::int32_t>;  // points along a border, with the hole to the left

  void take(const Triangle& triangle);
  bool faces(const Triangle& triangle) const;
  bool facesRoughly(const Triangle& triangle) const;
  bool hasRoom(std::int32_t point, std::int32_t from, std::int32_t to) const;
  bool connected(std::int32_t a, std::int32_t b) const;
  bool endsFan(const Sector& sector) const;
  std::int32_t nextAlongBorder(const Sector& sector) const;
  std::vector<Loop> borders() const;
  double lengthOf(const Loop& loop) const;
  void fill(Loop loop);

  template <class Visit>
  void visitSectors(std::int32_t point, const Visit& visit) const {
    for (std::int32_t i = first_sector_[std::size_t(point)]; i >= 0;
         i = sectors_[std::size_t(i)].next)
      visit(i, sectors_[std::size_t(i)]);
  }
  Eigen::Vector2d placeSeenFrom(std::int32_t point, std::int32_t other) const {
    return axes_[std::size_t(point)].at(points_.positions_mm[std::size_t(other)] -
                                        points_.positions_mm[std::size_t(point)]);
  }

  const OrientedPoints& points_;
  float least_cosine_;
  std::vector<PlaneAxes> axes_;
  std::vector<std::int32_t> first_sector_;
  std::vector<Sector> sectors_;
  std::vector<Triangle> triangles_;
};

}  // namespace softscope
