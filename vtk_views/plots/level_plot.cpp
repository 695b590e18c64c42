// vtk_views/plots/level_plot.cpp: curves in colours safe for colour blindness (Okabe and Ito).
#include "vtk_views/plots/level_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "vtk_views/plots/plot_axes.h"
#include "vtk_views/plots/plot_colours.h"

namespace softscope {
namespace {

constexpr std::array<Rgb8, 6> kColours{
    {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {230, 159, 0}, {86, 180, 233}}};
constexpr Rgb8 kLimit{140, 140, 140};
constexpr double kMostLimits = 3;  // end of the axis, in limits

double largest(double so_far, const std::vector<double>& values) {
  for (const double value : values)
    if (std::isfinite(value)) so_far = std::max(so_far, value);
  return so_far;
}

/// Legend of the crosses, right-aligned above the frame.
void drawCrossMeaning(const LevelPlotData& data, const PlotAxes& axes, double font_pt,
                      VectorDrawing& drawing) {
  const bool any = std::any_of(data.curves.begin(), data.curves.end(), [](const LevelCurve& c) {
    return std::any_of(c.mean.begin(), c.mean.end(), [](double v) { return !std::isfinite(v); });
  });
  if (!any) return;
  DrawnText meaning;
  meaning.text = "\xC3\x97 no result";
  meaning.at = {axes.right(), 2.5 * font_pt + 0.36 * font_pt};
  meaning.size_pt = font_pt;
  meaning.anchor = TextAnchor::kEnd;
  drawing.parts.emplace_back(std::move(meaning));
}

/// Filled regular polygon with `corners`.
void drawSpot(PointPt at, double radius_pt, int corners, Rgb8 colour, VectorDrawing& drawing) {
  DrawnShape spot;
  spot.colour = colour;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * M_PI * i / corners;
    spot.points.push_back(
        {at.x_pt + radius_pt * std::sin(angle), at.y_pt - radius_pt * std::cos(angle)});
  }
  drawing.parts.emplace_back(std::move(spot));
}

void drawCross(PointPt at, double radius_pt, Rgb8 colour, VectorDrawing& drawing) {
  for (const double side : {-1.0, 1.0})
    drawing.parts.emplace_back(DrawnLine{{{at.x_pt - radius_pt, at.y_pt - side * radius_pt},
                                          {at.x_pt + radius_pt, at.y_pt + side * radius_pt}},
                                         1.0,
                                         colour,
                                         false});
}

void drawCurveOf(const LevelCurve& curve, const PlotAxes& axes, Rgb8 colour,
                 VectorDrawing& drawing) {
  axes.drawCurve(curve.levels, curve.p95, {{}, 0.7, colour, true}, drawing);
  axes.drawCurve(curve.levels, curve.mean, {{}, 1.2, colour, false}, drawing);
  for (std::size_t i = 0; i < curve.levels.size(); ++i)
    if (std::isfinite(curve.mean[i]))
      drawSpot(axes.at(curve.levels[i], curve.mean[i]), 1.7, 16, colour, drawing);
    else
      drawCross({axes.xPt(curve.levels[i]), axes.top() + 4}, 2.4, colour, drawing);
}

void requireCurves(const LevelPlotData& data) {
  if (data.curves.empty()) throw Error("level plot: there is no curve to draw");
  for (const LevelCurve& curve : data.curves)
    if (curve.levels.empty() || curve.mean.size() != curve.levels.size() ||
        curve.p95.size() != curve.levels.size())
      throw Error("level plot: a curve needs a mean and a P95 for each of its levels");
}

std::vector<LegendEntry> legendOf(const LevelPlotData& data) {
  std::vector<LegendEntry> legend;
  if (data.curves.size() == 1) {
    legend = {{"mean", kColours[0]}, {"P95", kColours[0], false, true}};
  } else {
    for (std::size_t i = 0; i < data.curves.size(); ++i)
      legend.push_back({data.curves[i].name, kColours[i % kColours.size()]});
  }
  if (data.limit > 0) legend.push_back({"limit", kLimit, false, true});
  return legend;
}

AxisRange errorRange(const LevelPlotData& data) {
  double highest = std::max(1e-6, 1.1 * data.limit);
  for (const LevelCurve& curve : data.curves)
    highest = largest(largest(highest, curve.mean), curve.p95);
  if (data.limit > 0) highest = std::min(highest, kMostLimits * data.limit);
  return {0, 1.06 * highest};
}

DrawnText nameBelow(const PlotAxes& axes, double middle, const std::string& name, double font_pt) {
  DrawnText text;
  text.text = name;
  text.size_pt = font_pt;
  text.anchor = TextAnchor::kEnd;
  text.upwards = true;
  text.at = {axes.xPt(middle) + 0.35 * font_pt, axes.bottom() + 0.6 * font_pt};
  return text;
}

/// Frame with space for vertical names below.
PlotAxes axesAbove(const VectorDrawing& drawing, double names_pt, AxisRange x, AxisRange y,
                   double font_pt) {
  const PlotAxes plain = plotAxes(drawing, x, y, font_pt, {});
  return PlotAxes({plain.left(), plain.top()},
                  {plain.right(), drawing.height_pt - names_pt - 1.2 * font_pt}, x, y, font_pt);
}

}  // namespace

VectorDrawing drawLevels(const LevelPlotData& data, const PlotStyle& style) {
  requireCurves(data);
  double low = data.curves[0].levels.front(), high = low;
  for (const LevelCurve& curve : data.curves) {
    low = std::min(low, curve.levels.front());
    high = std::max(high, curve.levels.back());
  }
  VectorDrawing drawing = newPlotSheet(style.width_mm, style.height_mm);
  const PlotAxes axes =
      plotAxes(drawing, AxisRange::around(low, high), errorRange(data), style.font_pt, {});
  axes.drawGrid(drawing);
  if (data.limit > 0)
    drawing.parts.emplace_back(
        DrawnLine{{{axes.left(), axes.yPt(data.limit)}, {axes.right(), axes.yPt(data.limit)}},
                  0.7,
                  kLimit,
                  true});
  for (std::size_t i = 0; i < data.curves.size(); ++i)
    drawCurveOf(data.curves[i], axes, kColours[i % kColours.size()], drawing);
  axes.drawFrame(data.level_label, data.error_label, drawing);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  drawLegend(legendOf(data), {axes.left(), 2.5 * style.font_pt}, style.font_pt, drawing);
  drawCrossMeaning(data, axes, style.font_pt, drawing);
  return drawing;
}

VectorDrawing drawCaseBars(const CaseBarsData& data, const PlotStyle& style) {
  if (data.bars.empty()) throw Error("case bars: there is no bar to draw");
  double highest = 1e-6, names_pt = 0;
  bool published = false;
  for (const CaseBar& bar : data.bars) {
    highest = largest(highest, {bar.mean, bar.p95, bar.published});
    published = published || std::isfinite(bar.published);
    DrawnText name;
    name.text = bar.name;
    name.size_pt = style.font_pt;
    names_pt = std::max(names_pt, textWidthPt(name));
  }
  VectorDrawing drawing =
      newPlotSheet(style.width_mm, style.height_mm + std::max(0.0, names_pt / kPtPerMm - 8));
  const PlotAxes axes =
      axesAbove(drawing, names_pt, {0.4, static_cast<double>(data.bars.size()) + 0.6},
                {0, 1.06 * highest}, style.font_pt);
  axes.drawGrid(drawing);
  for (std::size_t i = 0; i < data.bars.size(); ++i) {
    const CaseBar& bar = data.bars[i];
    const double middle = static_cast<double>(i) + 1;
    axes.drawBar(middle, 0.36, bar.p95, kBarBlue, drawing);
    axes.drawBar(middle, 0.22, bar.mean, kColours[0], drawing);
    if (std::isfinite(bar.published))
      drawSpot(axes.at(middle, bar.published), 3, 4, kColours[1], drawing);
    drawing.parts.emplace_back(nameBelow(axes, middle, bar.name, style.font_pt));
  }
  axes.drawFrame("", data.error_label, drawing, /*x_numbers=*/false);
  drawPlotTitle(data.title, axes, style.font_pt, drawing);
  std::vector<LegendEntry> legend{{"mean", kColours[0], true}, {"up to P95", kBarBlue, true}};
  if (published) legend.push_back({data.published_label, kColours[1], true});
  drawLegend(legend, {axes.left(), 2.5 * style.font_pt}, style.font_pt, drawing);
  return drawing;
}

}  // namespace softscope
