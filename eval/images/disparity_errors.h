// eval/images/disparity_errors.h: errors of a disparity map against ground truth.
#pragma once

#include <cstddef>
#include <vector>

#include "core/image.h"
#include "core/raster.h"
#include "core/stereo_rig.h"
#include "eval/statistics/statistics.h"

namespace softscope {

struct DisparityErrorOptions {
  std::vector<double> bad_thresholds_px = {1, 2, 3};

  /// Throws OptionError: the field, its value, the violated rule.
  void validate() const;
};

/// Over measured pixels with known truth that are not masked.
struct DisparityErrors {
  Statistics absolute_px;           // |measured - truth|
  Statistics signed_px;             // measured - truth: positive = measured depth too small
  std::vector<double> bad_percent;  // share of absolute errors > bad_thresholds_px[i]
  /// Share of measured pixels among the unmasked pixels with a match
  /// inside the right image (u - truth inside it); NaN without any.
  double coverage_percent = Statistics::kNone;
  std::size_t matchable_count = 0;  // denominator of coverage_percent
};

/// NaN = unmeasured, or unknown truth. `ignore` is empty or of the size of the maps.
/// Throws InputError for different sizes, OptionError for a negative threshold.
DisparityErrors disparityErrors(const Raster<float>& measured_px, const Raster<float>& truth_px,
                                const DisparityErrorOptions& options = {}, const Mask& ignore = {});

/// Disparity of every known depth; NaN elsewhere.
Raster<float> disparityFromDepth(const Raster<float>& depth_mm, const RectifiedRig& rig);

}  // namespace softscope
