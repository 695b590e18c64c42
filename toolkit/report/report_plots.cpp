// toolkit/report/report_plots.cpp: plots of evaluate, without names of runs.
#include "toolkit/report/report_plots.h"

#include <cmath>

#include "toolkit/report/metric_paths.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {
namespace {

/// Empty unless a list of numbers.
std::vector<double> numbersAt(const FactSheet::Json& list) {
  std::vector<double> numbers;
  if (!list.is_array()) return numbers;
  for (const auto& entry : list) {
    if (!entry.is_number()) return {};
    numbers.push_back(entry.get<double>());
  }
  return numbers;
}

double interpolatedAt(const std::vector<std::pair<double, double>>& series, double x) {
  for (const auto& [at, value] : series)
    if (at == x) return value;
  return Statistics::kNone;
}

}  // namespace

OutcomeStripData outcomeStrip(const CaseFrames& frames) {
  OutcomeStripData strip;
  for (std::size_t i = 0; i < frames.x.size(); ++i)
    for (const FusionOutcome outcome :
         {FusionOutcome::kFused, FusionOutcome::kSkipped, FusionOutcome::kLost})
      if (frames.outcomes[i] == toString(outcome)) {
        strip.x.push_back(frames.x[i]);
        strip.outcomes.push_back(outcome);
      }
  return strip;
}

std::optional<CaptionedFigure> seriesFigure(const ReportCase& c) {
  const CaseFrames frames = framesOf(c);
  ErrorSeriesData data;
  data.title = "Error over time";
  data.time_label = frames.x_label;
  const auto medians = frames.series(metric_paths::kMedian),
             p95s = frames.series(metric_paths::kP95);
  for (const auto& [x, mean] : frames.series(metric_paths::kMean)) {
    data.times.push_back(x);
    data.mean.push_back(mean);
    data.median.push_back(interpolatedAt(medians, x));
    data.p95.push_back(interpolatedAt(p95s, x));
  }
  if (statistics(data.mean).count < 2) return std::nullopt;
  return CaptionedFigure{withOutcomeStrip(outcomeStrip(frames), drawErrorSeries(data)),
                         "Distance of the points of the model from the reference, per frame. Gap: "
                         "frames that were not fused."};
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
  data.title = "Histogram of the distances";
  data.low = low;
  data.high = high;
  for (const double count : counts) {
    so_far += count;
    data.shares.push_back(count / total);
    data.cumulative.push_back(so_far / total);
  }
  data.share_beyond = beyond / total;
  data.median = c.main(metric_paths::kMedian);
  data.p95 = c.main(metric_paths::kP95);
  return CaptionedFigure{
      drawErrorHistogram(data),
      "Share of the points per bin, and cumulative share; median and 95th percentile are marked."};
}

}  // namespace softscope
