// toolkit/depth/frame_statistics.cpp: percentiles and warnings.
#include "toolkit/depth/frame_statistics.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/error.h"
#include "eval/statistics/statistics.h"

namespace softscope {
namespace {

constexpr double kLeastCoverage = 0.05;  // half of the tissue and more is usual

std::vector<double> finite(const Raster<float>& raster) {
  std::vector<double> values;
  values.reserve(raster.size());
  std::copy_if(raster.values.begin(), raster.values.end(), std::back_inserter(values),
               [](float value) { return std::isfinite(value); });
  return values;
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

FrameCoverage coverageOf(const DepthResult& measured) {
  const std::vector<float>& depth_mm = measured.depth.depth_mm.values;
  FrameCoverage coverage;
  coverage.measured_pixels = std::count_if(depth_mm.begin(), depth_mm.end(),
                                           [](float value) { return std::isfinite(value); });
  const auto masked = std::count_if(measured.mask.values.begin(), measured.mask.values.end(),
                                    [](std::uint8_t value) { return value != 0; });
  const auto open_pixels = double(depth_mm.size()) - double(masked);
  coverage.share = open_pixels > 0 ? double(coverage.measured_pixels) / open_pixels : 0;
  return coverage;
}

FrameStatistics statisticsOf(const DepthResult& measured) {
  const std::vector<double> depth_mm =
      percentiles(finite(measured.depth.depth_mm), {1, 5, 50, 95, 99});
  const std::vector<double> sigma_mm = percentiles(finite(measured.depth.sigma_mm), {50});
  return {coverageOf(measured), depth_mm[0], depth_mm[1], depth_mm[2],
          depth_mm[3],          depth_mm[4], sigma_mm[0]};
}

FactSheet::Json frameJson(const DepthResult& measured) {
  const FrameStatistics statistics = statisticsOf(measured);
  FactSheet::Json json;
  json["coverage"] = statistics.coverage.share;
  json["measured_pixels"] = statistics.coverage.measured_pixels;
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

bool hasLittleDepth(const FrameCoverage& coverage) { return coverage.share < kLeastCoverage; }

std::string coverageWarning(const FrameCoverage& coverage, const std::string& causes) {
  if (!hasLittleDepth(coverage)) return {};
  const std::string unknown =
      "are left and right of one moment, not exchanged, not black, and is the calibration this "
      "scope's? `softscope info` tells";
  const std::string advice = ": " + (causes.empty() ? unknown : causes);
  if (coverage.measured_pixels == 0) throw InputError("no pixel could be measured" + advice);
  return "only " + fixed(100 * coverage.share, 1) + " % of the pixels could be measured" + advice;
}

std::string rowWarning(const DepthResult& measured) {
  const RowAlignment& rows = measured.rows;
  if (!rows.known() || rows.mean_row_difference_px <= RowAlignment::kWarnAbovePx) return {};
  std::string text = "rows differ by " + fixed(rows.mean_row_difference_px, 2) +
                     " px on average after rectification, but " +
                     fixed(RowAlignment::kWarnAbovePx, 1) + " px is the most that matches well";
  if (rows.agreeing_share < RowAlignment::kByChance)
    return text + ", and of the matches only " + fixed(100 * rows.agreeing_share, 0) +
           " % agree on the difference, as by chance: depth is not reliable. Do images and "
           "calibration belong together?";
  if (measured.rows_aligned)
    return text + "; removed, " + fixed(rows.residual_px, 2) +
           " px remain. Recalibrate if possible";
  return text + ". Recalibrate, or set depth.align_rows=true";
}

}  // namespace softscope
