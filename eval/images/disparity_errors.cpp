// eval/images/disparity_errors.cpp: statistics of the differences, and coverage.
#include "eval/images/disparity_errors.h"

#include <cmath>
#include <limits>

#include "eval/images/map_differences.h"
#include "eval/images/pixel_masks.h"

namespace softscope {

void DisparityErrorOptions::validate() const {
  requireThresholds("bad_thresholds_px", bad_thresholds_px);
}

DisparityErrors disparityErrors(const Raster<float>& measured_px, const Raster<float>& truth_px,
                                const DisparityErrorOptions& options, const Mask& ignore) {
  options.validate();
  const MapDifferences px = mapDifferences(measured_px, truth_px, ignore, "disparity map");
  DisparityErrors result;
  result.absolute_px = statistics(px.magnitude);
  result.signed_px = statistics(px.with_sign);
  result.bad_percent = percentsAbove(px.magnitude, options.bad_thresholds_px);
  const Mask unmatchable = ignoreEither(ignoreMatchesOutside(truth_px), ignore);
  std::size_t matchable = 0, matched = 0;
  for (std::size_t i = 0; i < measured_px.size(); ++i) {
    matchable += !unmatchable.values[i];
    matched += !unmatchable.values[i] && std::isfinite(measured_px.values[i]);
  }
  result.matchable_count = matchable;
  if (matchable > 0)
    result.coverage_percent = 100.0 * static_cast<double>(matched) / static_cast<double>(matchable);
  return result;
}

Raster<float> disparityFromDepth(const Raster<float>& depth_mm, const RectifiedRig& rig) {
  Raster<float> disparity_px(depth_mm.width_px, depth_mm.height_px,
                             std::numeric_limits<float>::quiet_NaN());
  for (std::size_t i = 0; i < depth_mm.size(); ++i)
    if (std::isfinite(depth_mm.values[i]) && depth_mm.values[i] > 0)
      disparity_px.values[i] = static_cast<float>(rig.disparityPx(depth_mm.values[i]));
  return disparity_px;
}

}  // namespace softscope
