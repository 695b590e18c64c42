// eval/simulation/sequence/track_points.cpp: barycentric coordinates.
#include "eval/simulation/sequence/track_points.h"

namespace softscope {

std::vector<TrackPoint> chooseTrackPoints(const Raster<RayHit>& first_hits, int spacing_px,
                                          double border) {
  std::vector<TrackPoint> points;
  const int left = static_cast<int>(border * first_hits.width_px);
  const int top = static_cast<int>(border * first_hits.height_px);
  for (int v = top; v < first_hits.height_px - top; v += spacing_px)
    for (int u = left; u < first_hits.width_px - left; u += spacing_px)
      if (const RayHit& hit = first_hits.at(u, v); hit.met())
        points.push_back({u, v, hit.triangle, hit.u, hit.v});
  return points;
}

Eigen::Vector3d positionOf(const TrackPoint& point, const std::vector<Eigen::Vector3f>& vertices_mm,
                           const std::vector<Triangle>& triangles) {
  const Triangle& t = triangles[point.triangle];
  return (1 - point.u - point.v) * vertices_mm[t[0]].cast<double>() +
         point.u * vertices_mm[t[1]].cast<double>() + point.v * vertices_mm[t[2]].cast<double>();
}

}  // namespace softscope
