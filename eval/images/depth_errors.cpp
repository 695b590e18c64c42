// eval/images/depth_errors.cpp: statistics of the differences, and coverage.
#include "eval/images/depth_errors.h"

#include <cmath>

#include "eval/images/map_differences.h"

namespace softscope {

void DepthErrorOptions::validate() const {
  requireThresholds("bad_thresholds_mm", bad_thresholds_mm);
}

DepthErrors depthErrors(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                        const DepthErrorOptions& options, const Mask& ignore) {
  options.validate();
  const MapDifferences mm = mapDifferences(measured_mm, truth_mm, ignore, "depth map");
  DepthErrors result;
  result.absolute_mm = statistics(mm.magnitude);
  result.signed_mm = statistics(mm.with_sign);
  result.bad_percent = percentsAbove(mm.magnitude, options.bad_thresholds_mm);
  for (std::size_t i = 0; i < truth_mm.size(); ++i)
    result.known_count +=
        (ignore.empty() || !ignore.values[i]) && std::isfinite(truth_mm.values[i]);
  if (result.known_count > 0)
    result.coverage_percent =
        100.0 * static_cast<double>(mm.magnitude.size()) / static_cast<double>(result.known_count);
  return result;
}

}  // namespace softscope
