// eval/simulation/sequence/track_points.h: material points selected in the first image.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/raster.h"
#include "core/triangle_mesh.h"
#include "eval/simulation/surface/ray_tree.h"

namespace softscope {

/// Fixed position on a triangle.
struct TrackPoint {
  int u_px = 0, v_px = 0;  // pixel in the first left image
  std::int32_t triangle = -1;
  double u = 0, v = 0;  // a + u (b - a) + v (c - a)
};

/// Grid of pixels on tissue, without a border of the share `border` of the width and height.
std::vector<TrackPoint> chooseTrackPoints(const Raster<RayHit>& first_hits, int spacing_px,
                                          double border);

Eigen::Vector3d positionOf(const TrackPoint& point, const std::vector<Eigen::Vector3f>& vertices_mm,
                           const std::vector<Triangle>& triangles);

}  // namespace softscope
