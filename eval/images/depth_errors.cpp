// eval/images/depth_errors.cpp: one pass over the pixels, then statistics.
#include "eval/images/depth_errors.h"

#include <cmath>

#include "core/error.h"
#include "eval/images/pixel_masks.h"

namespace softscope {

void DepthErrorOptions::validate() const {
  for (const double threshold_mm : bad_thresholds_mm)
    require(threshold_mm >= 0, "bad_thresholds_mm", threshold_mm, "can't be negative");
}

DepthErrors depthErrors(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                        const DepthErrorOptions& options, const Mask& ignore) {
  options.validate();
  requireSameShape(measured_mm, truth_mm, "depth map");
  requireSameShape(measured_mm, ignore, "depth map");
  DepthErrors result;
  std::vector<double> errors_mm, absolute_mm;
  for (std::size_t i = 0; i < measured_mm.size(); ++i) {
    if (!ignore.empty() && ignore.values[i]) continue;
    if (!std::isfinite(truth_mm.values[i])) continue;
    ++result.known_count;
    if (!std::isfinite(measured_mm.values[i])) continue;
    errors_mm.push_back(static_cast<double>(measured_mm.values[i]) - truth_mm.values[i]);
    absolute_mm.push_back(std::abs(errors_mm.back()));
  }
  result.absolute_mm = statistics(absolute_mm);
  result.signed_mm = statistics(errors_mm);
  for (const double threshold_mm : options.bad_thresholds_mm)
    result.bad_percent.push_back(percentAbove(absolute_mm, threshold_mm));
  if (result.known_count > 0)
    result.coverage_percent =
        100.0 * static_cast<double>(errors_mm.size()) / static_cast<double>(result.known_count);
  return result;
}

}  // namespace softscope
