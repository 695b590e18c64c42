// eval/images/map_differences.cpp: one pass over the pixels.
#include "eval/images/map_differences.h"

#include <cmath>

#include "core/error.h"
#include "eval/images/pixel_masks.h"
#include "eval/statistics/statistics.h"

namespace softscope {

MapDifferences mapDifferences(const Raster<float>& measured, const Raster<float>& truth,
                              const Mask& ignore, const char* what) {
  requireSameShape(measured, truth, what);
  requireSameShape(measured, ignore, what);
  MapDifferences differences;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    if (!ignore.empty() && ignore.values[i]) continue;
    if (!std::isfinite(measured.values[i]) || !std::isfinite(truth.values[i])) continue;
    differences.with_sign.push_back(static_cast<double>(measured.values[i]) - truth.values[i]);
    differences.magnitude.push_back(std::abs(differences.with_sign.back()));
  }
  return differences;
}

std::vector<double> percentsAbove(const std::vector<double>& values,
                                  const std::vector<double>& thresholds) {
  std::vector<double> percents;
  for (const double threshold : thresholds) percents.push_back(percentAbove(values, threshold));
  return percents;
}

void requireThresholds(const char* field, const std::vector<double>& thresholds) {
  for (const double threshold : thresholds)
    require(threshold >= 0, field, threshold, "can't be negative");
}

}  // namespace softscope
