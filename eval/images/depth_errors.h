// eval/images/depth_errors.h: errors of a depth map against ground truth.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"
#include "core/raster.h"
#include "eval/statistics/statistics.h"

namespace softscope {

struct DepthErrorOptions {
  std::vector<double> bad_thresholds_mm = {1, 2, 3};

  /// Throws OptionError: the field, its value, the rule it breaks.
  void validate() const;
};

/// Over measured pixels whose truth is known and that the mask does not ignore.
struct DepthErrors {
  Statistics absolute_mm;           // |measured - truth|
  Statistics signed_mm;             // measured - truth: positive = measured too far
  std::vector<double> bad_percent;  // share of absolute errors > bad_thresholds_mm[i]
  /// Measured share of the pixels whose truth is known and that the mask does not ignore; NaN
  /// where there are none.
  double coverage_percent = Statistics::kNone;
  std::size_t known_count = 0;  // what coverage_percent is a share of
};

/// NaN = unmeasured, or unknown truth. `ignore` is empty or of the maps' size; with
/// ignoreMatchesOutside(disparityFromDepth(truth)) only what both cameras can see is judged.
/// Throws InputError where sizes differ, OptionError for a negative threshold.
DepthErrors depthErrors(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                        const DepthErrorOptions& options = {}, const Mask& ignore = {});

}  // namespace softscope
