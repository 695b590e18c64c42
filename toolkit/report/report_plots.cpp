// toolkit/report/report_plots.cpp: as evaluate draws them, without the names of runs.
#include "toolkit/report/report_plots.h"

#include <cmath>

#include "vtk_views/series_plot.h"

namespace softscope {
namespace {

/// Empty where the list isn't one of numbers.
std::vector<double> numbersAt(const FactSheet::Json& list) {
  std::vector<double> numbers;
  if (!list.is_array()) return numbers;
  for (const auto& entry : list) {
    if (!entry.is_number()) return {};
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

}  // namespace

bool rises(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || (i > 0 && values[i] <= values[i - 1])) return false;
  return true;
}

std::optional<CaptionedFigure> seriesFigure(const ReportCase& c) {
  ErrorSeriesData data;
  data.times = c.overFrames("time_s");
  if (data.times.size() < 2) return std::nullopt;
  if (!rises(data.times)) {
    data.times = c.overFrames("frame");
    data.time_label = "frame";
    if (!rises(data.times)) return std::nullopt;
  }
  data.title = "Error over time";
  data.mean = c.overFrames("mean_mm");
  data.median = c.overFrames("median_mm");
  data.p95 = c.overFrames("p95_mm");
  return CaptionedFigure{drawErrorSeries(data),
                         "Distance of the model's points from the reference, moment by moment."};
}

std::optional<CaptionedFigure> histogramFigure(const ReportCase& c) {
  const double low = numberAt(c.record, "error_histogram.low_mm");
  const double high = numberAt(c.record, "error_histogram.high_mm");
  const auto counts_at = FactSheet::Json::json_pointer("/error_histogram/counts");
  if (!(low < high) || !c.record.contains(counts_at)) return std::nullopt;
  const std::vector<double> counts = numbersAt(c.record.at(counts_at));
  double total = std::max(numberAt(c.record, "error_histogram.beyond"), 0.0), so_far = 0;
  const double beyond = std::isfinite(total) ? total : 0;
  total = beyond;
  for (const double count : counts) total += count;
  if (counts.empty() || !(total > 0)) return std::nullopt;
  ErrorHistogramData data;
  data.title = "Spread of the distances";
  data.low = low;
  data.high = high;
  for (const double count : counts) {
    so_far += count;
    data.shares.push_back(count / total);
    data.cumulative.push_back(so_far / total);
  }
  data.share_beyond = beyond / total;
  data.median = c.main("median_mm");
  data.p95 = c.main("p95_mm");
  return CaptionedFigure{drawErrorHistogram(data),
                         "Share of the points in each bin, and of all below; median and 95th "
                         "percentile marked."};
}

}  // namespace softscope
