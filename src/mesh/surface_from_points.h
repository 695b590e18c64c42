// src/mesh/surface_from_points.h: surface reconstruction from oriented points.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_cloud.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// Which points are neighbours, and what is a hole. See docs/export.md.
struct SurfaceOptions {
  double gap_mm = 0;             // a circle this wide without points is a hole; 0: gap_spacings
  double gap_spacings = 5;       // … times the points' own spacing
  double max_angle_deg = 60;     // between normals of neighbours: two sides stay two
  double max_step_deg = 35;      // of the line between neighbours against their common plane
  double least_island_mm2 = 10;  // smaller pieces are dropped

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// A surface whose vertices are points of a cloud: nothing was moved, nothing invented.
struct PointSurface {
  TriangleMesh mesh;                     // with colours where the points have them
  std::vector<Eigen::Vector3f> normals;  // of each vertex, unit length
  std::vector<std::int32_t> points;      // of each vertex: its place in the cloud
  double spacing_mm = 0;                 // median distance of a point from its nearest neighbour
  double gap_mm = 0;                     // the widest gap that was closed
  std::size_t invalid_points = 0;        // not finite, or without a normal
  std::size_t crowded_points = 0;   // so near to another one that they make no surface of their own
  std::size_t dropped_islands = 0;  // pieces smaller than least_island_mm2 …
  std::size_t dropped_points = 0;   // … with so many points, lone ones included
};

/// Joins neighbouring points by triangles that face as their normals do. The result is manifold and
/// consistently oriented, and the same on any number of threads. Points must be one a normal.
/// Throws InputError where there are no points, no normals, or no surface comes about.
PointSurface surfaceFromPoints(const PointCloud& cloud, const SurfaceOptions& options = {});

}  // namespace softscope
