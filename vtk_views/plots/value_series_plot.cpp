// vtk_views/plots/value_series_plot.cpp: a frame, a line, dots.
#include "vtk_views/plots/value_series_plot.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/plot_colours.h"

namespace softscope {
namespace {

constexpr std::size_t kMostDots = 120;  // more would only make the line thicker

AxisRange rangeOf(const std::vector<double>& values) {
  double low = 0, high = 0;
  bool any = false;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
  if (!any) throw Error("value series: there is nothing to draw");
  return AxisRange::around(low, high);
}

}  // namespace

VectorDrawing drawValueSeries(const ValueSeriesData& data, const PlotStyle& style) {
  if (data.x.size() != data.y.size()) throw Error("value series: one x a value");
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  const PlotAxes axes =
      plotAxes(drawing, rangeOf(data.x), rangeOf(data.y), style.font_pt, {0.8, 1.2});
  axes.drawGrid(drawing);
  axes.drawCurve(data.x, data.y, {{}, 1.0, kPlotBlue, false}, drawing);
  DrawnDots dots;
  dots.diameter_pt = 2.2;
  dots.colour = kPlotBlue;
  for (std::size_t i = 0; i < data.x.size(); ++i)
    if (std::isfinite(data.x[i]) && std::isfinite(data.y[i]))
      dots.centres.push_back(axes.at(data.x[i], data.y[i]));
  if (dots.centres.size() <= kMostDots) drawing.parts.emplace_back(std::move(dots));
  axes.drawFrame(data.x_label, data.y_label, drawing);
  return drawing;
}

}  // namespace softscope
