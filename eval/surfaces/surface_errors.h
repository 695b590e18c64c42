// eval/surfaces/surface_errors.h: statistics of point-to-surface distances.
#pragma once

#include <cstddef>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"

namespace softscope {

struct SurfaceErrors {
  Statistics distance_mm;        // of all points
  Statistics signed_mm;          // positive = outside; NaN for border points
  std::size_t border_count = 0;  // points with a closest point on the border of the surface
};

SurfaceErrors surfaceErrors(const std::vector<ClosestPoint>& closest);

}  // namespace softscope
