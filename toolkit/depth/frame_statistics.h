// toolkit/depth/frame_statistics.h: depth statistics of one frame.
#pragma once

#include "toolkit/depth/depth_estimator.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct FrameCoverage {
  double share = 0;  // measured pixels / unmasked pixels
  long measured_pixels = 0;
};

struct FrameStatistics {
  FrameCoverage coverage;
  double p1_mm = 0, p5_mm = 0, median_mm = 0, p95_mm = 0, p99_mm = 0;  // NaN without depth
  double median_sigma_mm = 0;  // predicted standard error; NaN if unknown
};

FrameCoverage coverageOf(const DepthResult& measured);
FrameStatistics statisticsOf(const DepthResult& measured);

/// Coverage, depth percentiles, vertical disparity, milliseconds per stage; units in key names.
FactSheet::Json frameJson(const DepthResult& measured);

/// True for a very small coverage.
bool hasLittleDepth(const FrameCoverage& coverage);

/// Warning for a very small coverage, else empty, with `causes` if these are known. Throws
/// InputError if no pixel was measured.
std::string coverageWarning(const FrameCoverage& coverage, const std::string& causes);

/// Warning for a lasting vertical disparity above RowAlignment::kWarnAbovePx, else empty.
std::string rowWarning(const DepthResult& measured);

}  // namespace softscope
