// eval/images/disparity_errors.cpp: one pass over the pixels, then statistics.
#include "eval/images/disparity_errors.h"

#include <cmath>
#include <limits>

#include "core/error.h"
#include "eval/images/pixel_masks.h"

namespace softscope {

void DisparityErrorOptions::validate() const {
  for (const double threshold_px : bad_thresholds_px)
    require(threshold_px >= 0, "bad_thresholds_px", threshold_px, "can't be negative");
}

DisparityErrors disparityErrors(const Raster<float>& measured_px, const Raster<float>& truth_px,
                                const DisparityErrorOptions& options, const Mask& ignore) {
  options.validate();
  requireSameShape(measured_px, truth_px, "disparity map");
  requireSameShape(measured_px, ignore, "disparity map");
  const Mask unmatchable = ignoreMatchesOutside(truth_px);
  std::vector<double> errors_px, absolute_px;
  std::size_t matchable = 0, matched = 0;
  for (std::size_t i = 0; i < measured_px.size(); ++i) {
    if (!ignore.empty() && ignore.values[i]) continue;
    const bool measured = std::isfinite(measured_px.values[i]);
    matchable += !unmatchable.values[i];
    matched += measured && !unmatchable.values[i];
    if (!measured || !std::isfinite(truth_px.values[i])) continue;
    errors_px.push_back(static_cast<double>(measured_px.values[i]) - truth_px.values[i]);
    absolute_px.push_back(std::abs(errors_px.back()));
  }
  DisparityErrors result;
  result.absolute_px = statistics(absolute_px);
  result.signed_px = statistics(errors_px);
  for (const double threshold_px : options.bad_thresholds_px)
    result.bad_percent.push_back(percentAbove(absolute_px, threshold_px));
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
