// eval/surfaces/surface_errors.h: the distances of many points from a surface, in a few numbers.
#pragma once

#include <cstddef>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "eval/statistics/statistics.h"

namespace softscope {

struct SurfaceErrors {
  Statistics distance_mm;        // of all points
  Statistics signed_mm;          // positive = outside; border points count as NaN
  std::size_t border_count = 0;  // points whose closest point lies on the surface's border
};

SurfaceErrors surfaceErrors(const std::vector<ClosestPoint>& closest);

}  // namespace softscope
