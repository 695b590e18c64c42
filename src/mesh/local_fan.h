// src/mesh/local_fan.h: triangle fan of a point in its tangent plane.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/point_grid.h"

namespace softscope {

/// Valid points: finite, with unit normals.
struct OrientedPoints {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Eigen::Vector3f> normals;
};

/// Conditions of neighbourhood of two points on a surface.
struct NeighbourRule {
  float least_cosine = 0.5f;    // between their normals
  float most_step = 0.57f;      // sine of the angle between their line and the mean tangent plane
  float noise_mm = 0.05f;       // smaller steps are ignored
  float hole_radius_mm = 0.5f;  // a circle of this radius without points is a hole

  bool join(const OrientedPoints& points, std::int32_t a, std::int32_t b) const;
};

/// Two axes in the plane of a unit normal; right-handed with it.
struct PlaneAxes {
  explicit PlaneAxes(const Eigen::Vector3f& normal);
  Eigen::Vector2d at(const Eigen::Vector3f& offset_mm) const {
    return {double(offset_mm.dot(u)), double(offset_mm.dot(v))};
  }
  Eigen::Vector3f u, v;
};

/// Triangle of a point: the point, then these two, counter-clockwise about its normal.
struct FanTriangle {
  std::int32_t first, second;
  float radius_mm;  // circumscribed circle
};

/// Delaunay triangles at a point among its neighbours by `rule`, projected
/// along its normal, without those whose circle is a hole. Reuses its memory.
class LocalFan {
 public:
  LocalFan(const OrientedPoints& points, const PointGrid& grid, const NeighbourRule& rule)
      : points_(points), grid_(grid), rule_(rule) {}

  const std::vector<FanTriangle>& around(std::int32_t point);

 private:
  struct Neighbour {
    std::int32_t point;
    Eigen::Vector2d place_mm;
    double squared_mm2;
  };
  /// Corner of the Voronoi cell, with the neighbour of the bisector that begins there.
  struct Corner {
    Eigen::Vector2d place_mm;
    std::int32_t neighbour;  // into neighbours_; -1: initial square
  };
  void gather(std::int32_t point, float reach_mm);
  double cutWithin(std::int32_t point, float reach_mm);
  void cutBy(std::int32_t neighbour);
  double reachOfCell() const;

  const OrientedPoints& points_;
  const PointGrid& grid_;
  NeighbourRule rule_;
  std::vector<Neighbour> neighbours_;
  std::vector<Corner> cell_, cut_;
  std::vector<FanTriangle> fan_;
};

}  // namespace softscope
