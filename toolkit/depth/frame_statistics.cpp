// toolkit/depth/frame_statistics.cpp: percentiles and warnings.
#include "toolkit/depth/frame_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kLeastCoverage = 0.05;  // half of the tissue and more is usual

std::vector<float> sortedFinite(const Raster<float>& raster) {
  std::vector<float> values;
  std::copy_if(raster.values.begin(), raster.values.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  std::sort(values.begin(), values.end());
  return values;
}

/// Linear interpolation between neighbours.
double quantile(const std::vector<float>& sorted, double part) {
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double place = part * double(sorted.size() - 1);
  const auto below = std::size_t(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (place - double(below)) * (double(sorted[above]) - sorted[below]);
}

FactSheet::Json rowsJson(const DepthResult& measured) {
  const RowAlignment& rows = measured.rows;
  FactSheet::Json json{{"matches", rows.matches}, {"known", rows.known()}};
  if (!rows.known()) return json;
  json["mean_row_difference_px"] = rows.mean_row_difference_px;
  json["shift_px"] = rows.shift_px();
  json["tilt_px_per_px"] = rows.tilt_px_per_px();
  json["residual_px"] = rows.residual_px;
  json["removed"] = measured.rows_aligned;
  return json;
}

}  // namespace

FrameStatistics statisticsOf(const DepthResult& measured) {
  FrameStatistics statistics;
  const std::vector<float> depth_mm = sortedFinite(measured.depth.depth_mm);
  const auto masked = std::count_if(measured.mask.values.begin(), measured.mask.values.end(),
                                    [](std::uint8_t value) { return value != 0; });
  const auto open_pixels = double(measured.depth.depth_mm.size()) - double(masked);
  statistics.measured_pixels = long(depth_mm.size());
  statistics.coverage = open_pixels > 0 ? double(depth_mm.size()) / open_pixels : 0;
  statistics.p1_mm = quantile(depth_mm, 0.01);
  statistics.p5_mm = quantile(depth_mm, 0.05);
  statistics.median_mm = quantile(depth_mm, 0.5);
  statistics.p95_mm = quantile(depth_mm, 0.95);
  statistics.p99_mm = quantile(depth_mm, 0.99);
  statistics.median_sigma_mm = quantile(sortedFinite(measured.depth.sigma_mm), 0.5);
  return statistics;
}

FactSheet::Json frameJson(const DepthResult& measured) {
  const FrameStatistics statistics = statisticsOf(measured);
  FactSheet::Json json;
  json["coverage"] = statistics.coverage;
  json["measured_pixels"] = statistics.measured_pixels;
  json["points"] = measured.cloud.points_mm.size();
  json["depth_mm"] = {{"p1", statistics.p1_mm},
                      {"p5", statistics.p5_mm},
                      {"median", statistics.median_mm},
                      {"p95", statistics.p95_mm},
                      {"p99", statistics.p99_mm}};
  json["median_predicted_error_mm"] = statistics.median_sigma_mm;
  if (!measured.disparity.disparity_px.empty()) json["rows"] = rowsJson(measured);
  auto& times = json["elapsed_ms"] = FactSheet::Json::object();
  for (const auto& [stage, elapsed_ms] : measured.times) times[stage] = elapsed_ms;
  return json;
}

std::string coverageWarning(const DepthResult& measured) {
  const std::string advice =
      ": are left and right of one moment, not exchanged, not black, and is the calibration this "
      "scope's? `softscope info` tells";
  const FrameStatistics statistics = statisticsOf(measured);
  if (statistics.measured_pixels == 0) throw InputError("no pixel could be measured" + advice);
  if (statistics.coverage >= kLeastCoverage) return {};
  return "only " + fixed(100 * statistics.coverage, 1) + " % of the pixels could be measured" +
         advice;
}

std::string rowWarning(const DepthResult& measured) {
  const RowAlignment& rows = measured.rows;
  if (!rows.known() || rows.mean_row_difference_px <= RowAlignment::kWarnAbovePx) return {};
  std::string text = "rows differ by " + fixed(rows.mean_row_difference_px, 2) +
                     " px on average after rectification, but " +
                     fixed(RowAlignment::kWarnAbovePx, 1) + " px is the most that matches well";
  if (measured.rows_aligned)
    return text + "; removed, " + fixed(rows.residual_px, 2) +
           " px remain. Recalibrate if possible";
  return text + ". Recalibrate, or set depth.align_rows=true";
}

}  // namespace softscope
