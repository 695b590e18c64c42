// toolkit/depth/frame_statistics.h: depth statistics of one frame.
#pragma once

#include "toolkit/depth/depth_estimator.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct FrameStatistics {
  double coverage = 0;  // measured pixels / pixels that the mask leaves
  long measured_pixels = 0;
  double p1_mm = 0, p5_mm = 0, median_mm = 0, p95_mm = 0, p99_mm = 0;  // NaN without depth
  double median_sigma_mm = 0;  // predicted standard error; NaN where unknown
};

FrameStatistics statisticsOf(const DepthResult& measured);

/// Coverage, depth percentiles, rows, milliseconds a stage; units in key names.
FactSheet::Json frameJson(const DepthResult& measured);

/// One line if hardly a pixel was measured; else empty. Throws InputError where none was.
std::string coverageWarning(const DepthResult& measured);

/// One line if rows are off by more than RowAlignment::kWarnAbovePx and stay so; else empty.
std::string rowWarning(const DepthResult& measured);

}  // namespace softscope
