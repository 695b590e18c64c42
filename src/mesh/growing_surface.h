// src/mesh/growing_surface.h: triangles added only where the surface stays manifold.
#pragma once

#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"
#include "mesh/local_fan.h"

namespace softscope {

/// Triangles between points, each side in two of them at most, those of a point side by side in its
/// plane without overlap: manifold (but for sheets that touch in a point alone) and oriented.
class GrowingSurface {
 public:
  /// Keeps a reference to `points`. `least_cosine`: between a triangle's normal and its points'.
  GrowingSurface(const OrientedPoints& points, float least_cosine);

  /// Whether it fits and was taken.
  bool add(const Triangle& triangle);

  /// Fills holes whose border is at most `longest_mm` long, as far as triangles can face the way
  /// that their points do on the whole.
  void closeHoles(double longest_mm);

  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  /// At a point, a triangle spans the sector from one other point to the next.
  struct Sector {
    std::int32_t at, from, to;
    std::int32_t next;  // sector of the same point; -1: the last
  };
  using Loop = std::vector<std::int32_t>;  // points along a border, the hole to the left

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
