// src/mesh/local_fan.h: triangle fan of one point in its tangent plane.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "mesh/point_grid.h"

namespace softscope {

/// Points that are fit for a surface: finite, with unit normals.
struct OrientedPoints {
  std::vector<Eigen::Vector3f> positions_mm;
  std::vector<Eigen::Vector3f> normals;
};

/// When two points can be neighbours on one surface.
struct NeighbourRule {
  float least_cosine = 0.5f;    // between their normals
  float most_step = 0.57f;      // of their line against the plane between them: a sine
  float noise_mm = 0.05f;       // steps lower than this are no steps
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

/// One of a point's triangles: the point, then these two, counter-clockwise about its normal.
struct FanTriangle {
  std::int32_t first, second;
  float radius_mm;  // of its circle through three points
};

/// The Delaunay triangles at a point among the neighbours that `rule` lets it have, projected along
/// its normal, whose circles are no holes. Keeps its memory from call to call.
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
  /// A corner of the point's cell, and the neighbour whose bisector leaves it.
  struct Corner {
    Eigen::Vector2d place_mm;
    std::int32_t neighbour;  // into neighbours_; -1: the square that the cell began as
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
