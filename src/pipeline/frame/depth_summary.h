// src/pipeline/frame/depth_summary.h: what a frame shows, in numbers.
#pragma once

#include <limits>

namespace softscope {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct DepthSummary {
  int tissue_px = 0;    // that no mask hides, and light reaches
  int measured_px = 0;  // of those
  double median_sigma_mm = kUnknown;
  /// Of the measured pixels: their predicted error is tolerable with a probability of 95 %.
  double precise_share = kUnknown;
  double mm_per_px = kUnknown;          // of depth by disparity, at the median depth
  double limit_scale = 1;               // of limits in mm, which hold for near tissue
  double row_difference_px = kUnknown;  // as found after rectification
  double coverage() const { return tissue_px > 0 ? double(measured_px) / tissue_px : 0; }
};

}  // namespace softscope
