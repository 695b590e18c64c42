// vtk_views/plots/agreement_plot.cpp: bands, lines, dots.
#include "vtk_views/plots/agreement_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/plot_colours.h"

namespace softscope {
namespace {

constexpr Rgb8 kBlueBand{214, 228, 240}, kWarmBand{248, 226, 208}, kZero{150, 150, 150};
constexpr double kCaseDotPt = 4;

struct Extent {
  double low = HUGE_VAL, high = -HUGE_VAL;

  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

void drawBand(const AgreementLevel& level, const PlotAxes& axes, Rgb8 colour,
              VectorDrawing& drawing) {
  if (!std::isfinite(level.low) || !std::isfinite(level.high)) return;
  drawing.parts.emplace_back(DrawnShape{{{axes.left(), axes.yPt(level.low)},
                                         {axes.right(), axes.yPt(level.low)},
                                         {axes.right(), axes.yPt(level.high)},
                                         {axes.left(), axes.yPt(level.high)}},
                                        colour});
}

/// Horizontal line with its name and value next to the frame.
void drawLevel(const AgreementLevel& level, const char* name, const PlotAxes& axes,
               const DrawnLine& style, double font_pt, VectorDrawing& drawing) {
  if (!std::isfinite(level.value)) return;
  DrawnLine line = style;
  line.points = {{axes.left(), axes.yPt(level.value)}, {axes.right(), axes.yPt(level.value)}};
  drawing.parts.emplace_back(line);
  char number[32];
  std::snprintf(number, sizeof number, "%.3f", level.value);
  DrawnText text;
  text.size_pt = font_pt;
  text.colour = style.colour;
  text.at = {axes.right() + 4, axes.yPt(level.value) - 0.2 * font_pt};
  text.text = name;
  drawing.parts.emplace_back(text);
  text.at.y_pt += 1.1 * font_pt;
  text.text = number;
  drawing.parts.emplace_back(text);
}

}  // namespace

VectorDrawing drawAgreement(const AgreementData& data, const PlotStyle& style) {
  if (data.x.size() != data.differences.size()) throw Error("agreement: one x a difference");
  Extent x, y;
  DrawnDots dots;
  for (std::size_t i = 0; i < data.x.size(); ++i) {
    if (!std::isfinite(data.x[i]) || !std::isfinite(data.differences[i])) continue;
    x.add(data.x[i]);
    y.add(data.differences[i]);
  }
  if (!(x.low <= x.high)) throw Error("agreement: there is nothing to draw");
  y.add(0);
  for (const AgreementLevel& level : {data.bias, data.low_limit, data.high_limit})
    for (const double value : {level.value, level.low, level.high}) y.add(value);
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  const PlotAxes axes = plotAxes(drawing, AxisRange::around(x.low, x.high),
                                 AxisRange::around(y.low, y.high), style.font_pt, {2.2, 6.4});
  for (const AgreementLevel& limit : {data.low_limit, data.high_limit})
    drawBand(limit, axes, kWarmBand, drawing);
  drawBand(data.bias, axes, kBlueBand, drawing);
  drawing.parts.emplace_back(
      DrawnLine{{{axes.left(), axes.yPt(0)}, {axes.right(), axes.yPt(0)}}, 0.5, kZero});
  drawLevel(data.low_limit, "lower limit", axes, {{}, 0.9, kPlotVermilion, true}, style.font_pt,
            drawing);
  drawLevel(data.high_limit, "upper limit", axes, {{}, 0.9, kPlotVermilion, true}, style.font_pt,
            drawing);
  drawLevel(data.bias, "bias", axes, {{}, 1.1, kPlotBlue, false}, style.font_pt, drawing);
  dots.diameter_pt = kCaseDotPt;
  for (std::size_t i = 0; i < data.x.size(); ++i)
    if (std::isfinite(data.x[i]) && std::isfinite(data.differences[i]))
      dots.centres.push_back(axes.at(data.x[i], data.differences[i]));
  drawing.parts.emplace_back(std::move(dots));
  axes.drawFrame(data.x_label, data.y_label, drawing);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  return drawing;
}

}  // namespace softscope
