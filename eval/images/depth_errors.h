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

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Over measured pixels with known truth that are not masked.
struct DepthErrors {
  Statistics absolute_mm;           // |measured - truth|
  Statistics signed_mm;             // measured - truth: positive = measured depth too large
  std::vector<double> bad_percent;  // share of absolute errors > bad_thresholds_mm[i]
  /// Share of measured pixels among the unmasked
  /// pixels with known truth; NaN without any.
  double coverage_percent = Statistics::kNone;
  std::size_t known_count = 0;  // denominator of coverage_percent
};

/// NaN = unmeasured, or unknown truth. `ignore` is empty or of the size of the maps;
/// ignoreMatchesOutside(disparityFromDepth(truth)) restricts the evaluation to pixels inside
/// both images. Throws InputError for different sizes, OptionError for a negative threshold.
DepthErrors depthErrors(const Raster<float>& measured_mm, const Raster<float>& truth_mm,
                        const DepthErrorOptions& options = {}, const Mask& ignore = {});

}  // namespace softscope
