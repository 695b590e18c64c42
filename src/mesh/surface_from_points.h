// src/mesh/surface_from_points.h: surface reconstruction from oriented points.
#pragma once

#include <cstdint>
#include <vector>

#include "core/point_cloud.h"
#include "core/triangle_mesh.h"

namespace softscope {

/// Rules of neighbourhood and holes. See docs/export.md.
struct SurfaceOptions {
  double gap_mm = 0;             // a circle of this width without points is a hole; 0: gap_spacings
  double gap_spacings = 5;       // … times the point spacing
  double max_angle_deg = 60;     // between normals of neighbours: separates two sides
  double max_step_deg = 35;      // of the line between neighbours to their common plane
  double least_island_mm2 = 10;  // smaller pieces are dropped

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Surface whose vertices are unmodified points of a cloud.
struct PointSurface {
  TriangleMesh mesh;                     // with the colours of the points, if any
  std::vector<Eigen::Vector3f> normals;  // of each vertex, unit length
  std::vector<std::int32_t> points;      // index of each vertex in the cloud
  double spacing_mm = 0;                 // median distance of a point to its nearest neighbour
  double gap_mm = 0;                     // widest closed gap
  std::size_t invalid_points = 0;        // not finite, or without a normal
  std::size_t crowded_points = 0;        // too close to another point to be used
  std::size_t dropped_islands = 0;       // pieces smaller than least_island_mm2 …
  std::size_t dropped_points = 0;        // … with this number of points, including isolated ones
};

/// Connects neighbouring points by triangles oriented as their normals. The result is
/// manifold, consistently oriented and independent of the number of threads. Requires
/// one normal per point. Throws InputError without points, normals or a surface.
PointSurface surfaceFromPoints(const PointCloud& cloud, const SurfaceOptions& options = {});

}  // namespace softscope
