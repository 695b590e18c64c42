// eval/surfaces/surface_errors.cpp: collects distances for the statistics.
#include "eval/surfaces/surface_errors.h"

namespace softscope {

SurfaceErrors surfaceErrors(const std::vector<ClosestPoint>& closest) {
  std::vector<double> distances_mm, signed_mm;
  SurfaceErrors errors;
  for (const ClosestPoint& c : closest) {
    distances_mm.push_back(c.distance_mm);
    signed_mm.push_back(c.signed_distance_mm);
    errors.border_count += c.on_border;
  }
  errors.distance_mm = statistics(distances_mm);
  errors.signed_mm = statistics(signed_mm);
  return errors;
}

}  // namespace softscope
