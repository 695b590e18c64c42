// vtk_views/plots/series_plot.cpp: two plots in
// colours safe for colour blindness (Okabe and Ito).
#include "vtk_views/plots/series_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/plot_colours.h"

namespace softscope {
namespace {

constexpr Rgb8 kBand{214, 228, 240}, kBandEdge{140, 170, 200}, kBars{150, 190, 220},
    kSeriesGrey{110, 110, 110};

double largestFinite(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values)
    if (std::isfinite(value)) largest = std::max(largest, value);
  return largest;
}

bool anyFinite(const std::vector<double>& values) {
  return std::any_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

/// From 0 to the 95th percentile, with gaps at missing values.
void drawBand(const ErrorSeriesData& data, const PlotAxes& axes, VectorDrawing& drawing) {
  DrawnShape band;
  band.colour = kBand;
  const auto finishPiece = [&] {
    if (!band.points.empty()) {
      const double last = band.points.back().x_pt, first = band.points.front().x_pt;
      band.points.push_back({last, axes.yPt(0)});
      band.points.push_back({first, axes.yPt(0)});
      drawing.parts.emplace_back(band);
    }
    band.points.clear();
  };
  for (std::size_t i = 0; i < data.times.size(); ++i)
    if (std::isfinite(data.times[i]) && std::isfinite(data.p95[i]))
      band.points.push_back(axes.at(data.times[i], data.p95[i]));
    else
      finishPiece();
  finishPiece();
}

void drawBars(const ErrorHistogramData& data, const PlotAxes& axes, VectorDrawing& drawing) {
  const double width = (data.high - data.low) / static_cast<double>(data.shares.size());
  for (std::size_t i = 0; i < data.shares.size(); ++i) {
    if (!(data.shares[i] > 0)) continue;
    const double from = data.low + static_cast<double>(i) * width;
    drawing.parts.emplace_back(
        DrawnShape{{axes.at(from, 0), axes.at(from, 100 * data.shares[i]),
                    axes.at(from + width, 100 * data.shares[i]), axes.at(from + width, 0)},
                   kBars});
  }
}

DrawnText markText(const PlotAxes& axes, double value, const char* name, double font_pt) {
  char number[48];
  std::snprintf(number, sizeof number, "%s %.2f mm", name, value);
  DrawnText text;
  text.at = {axes.xPt(value), axes.top() - 0.4 * font_pt};
  text.text = number;
  text.size_pt = font_pt;
  text.anchor = TextAnchor::kMiddle;
  text.colour = kPlotVermilion;
  return text;
}

/// Dashed lines at the median and the 95th percentile, labelled
/// above the frame: centred if there is space, else side by side.
void drawMarks(const ErrorHistogramData& data, const PlotAxes& axes, double font_pt,
               VectorDrawing& drawing) {
  if (!std::isfinite(data.median) || !std::isfinite(data.p95)) return;
  DrawnText median = markText(axes, data.median, "median", font_pt);
  DrawnText p95 = markText(axes, data.p95, "P95", font_pt);
  for (const DrawnText& text : {median, p95})
    drawing.parts.emplace_back(DrawnLine{
        {{text.at.x_pt, axes.top()}, {text.at.x_pt, axes.bottom()}}, 0.6, kPlotVermilion, true});
  const double first_pt = textWidthPt(median), second_pt = textWidthPt(p95);
  if (p95.at.x_pt - median.at.x_pt < (first_pt + second_pt) / 2 + font_pt) {
    const double both_pt = first_pt + font_pt + second_pt;
    median.anchor = p95.anchor = TextAnchor::kStart;
    median.at.x_pt = std::clamp((median.at.x_pt + p95.at.x_pt - both_pt) / 2, axes.left(),
                                std::max(axes.left(), axes.right() - both_pt));
    p95.at.x_pt = median.at.x_pt + first_pt + font_pt;
  }
  drawing.parts.emplace_back(median);
  drawing.parts.emplace_back(p95);
}

void drawCumulative(const ErrorHistogramData& data, const PlotAxes& axes, AxisRange range,
                    VectorDrawing& drawing) {
  const PlotAxes shares({axes.left(), axes.top()}, {axes.right(), axes.bottom()},
                        {data.low, data.high}, range, 1);
  std::vector<double> x{data.low}, y{0};
  for (std::size_t i = 0; i < data.cumulative.size(); ++i) {
    x.push_back(data.low + (data.high - data.low) * static_cast<double>(i + 1) /
                               static_cast<double>(data.cumulative.size()));
    y.push_back(100 * data.cumulative[i]);
  }
  shares.drawCurve(x, y, {{}, 1.2, kPlotBlue, false}, drawing);
}

void requireSeries(const ErrorSeriesData& data) {
  const std::size_t n = data.times.size();
  if (data.mean.size() != n || data.median.size() != n || data.p95.size() != n)
    throw Error("error series: times, mean, median and P95 must be equally many");
  if (!anyFinite(data.times) || !anyFinite(data.mean))
    throw Error("error series: there is nothing to draw");
}

}  // namespace

VectorDrawing drawErrorSeries(const ErrorSeriesData& data, const PlotStyle& style) {
  requireSeries(data);
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  std::vector<double> times;
  for (const double time : data.times)
    if (std::isfinite(time)) times.push_back(time);
  const auto range = std::minmax_element(times.begin(), times.end());
  const double without_title = data.title.empty() ? 1.4 : 0;  // space of the title, in font sizes
  const double highest = std::max({largestFinite(data.p95), largestFinite(data.mean), 1e-6});
  const PlotAxes axes = plotAxes(drawing, AxisRange::around(*range.first, *range.second),
                                 {0, 1.06 * highest}, style.font_pt, {3.4 - without_title, 1.2});
  drawBand(data, axes, drawing);
  axes.drawGrid(drawing);
  axes.drawCurve(data.times, data.p95, {{}, 0.6, kBandEdge, false}, drawing);
  axes.drawCurve(data.times, data.median, {{}, 1.2, kPlotVermilion, true}, drawing);
  axes.drawCurve(data.times, data.mean, {{}, 1.2, kPlotBlue, false}, drawing);
  axes.drawFrame(data.time_label, data.error_label, drawing);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  drawLegend(
      {{"mean", kPlotBlue}, {"median", kPlotVermilion, false, true}, {"up to P95", kBand, true}},
      {axes.left(), (2.5 - without_title) * style.font_pt}, style.font_pt, drawing);
  return drawing;
}

VectorDrawing drawErrorHistogram(const ErrorHistogramData& data, const PlotStyle& style) {
  if (data.shares.empty() || data.shares.size() != data.cumulative.size() ||
      !(data.low < data.high))
    throw Error("error histogram: it needs bins, and as many cumulative shares");
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  const double highest = std::max(100 * largestFinite(data.shares), 1e-3);
  const AxisRange all{0, 105};
  const PlotAxes axes =
      plotAxes(drawing, {data.low, data.high}, {0, 1.06 * highest}, style.font_pt, {4.6, 4.6});
  axes.drawGrid(drawing);
  drawBars(data, axes, drawing);
  drawCumulative(data, axes, all, drawing);
  drawMarks(data, axes, style.font_pt, drawing);
  axes.drawFrame(data.error_label, "points in the bin [%]", drawing);
  axes.drawRightAxis(all, "points below [%]", drawing);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  std::vector<LegendEntry> legend{{"histogram", kBars, true}, {"cumulative", kPlotBlue}};
  drawLegend(legend, {axes.left(), 2.5 * style.font_pt}, style.font_pt, drawing);
  if (data.share_beyond > 0) {
    char note[64];
    std::snprintf(note, sizeof note, "%.2g %% beyond \xE2\x86\x92", 100 * data.share_beyond);
    DrawnText text;
    text.at = {drawing.width_pt - 0.5 * style.font_pt, 2.86 * style.font_pt};  // after the legend
    text.text = note;
    text.size_pt = style.font_pt;
    text.anchor = TextAnchor::kEnd;
    text.colour = kSeriesGrey;
    drawing.parts.emplace_back(text);
  }
  return drawing;
}

}  // namespace softscope
