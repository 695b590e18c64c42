// vtk_views/plots/plot_axes.cpp: ticks with round numbers, axis labels.
#include "vtk_views/plots/plot_axes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softscope {
namespace {

constexpr Rgb8 kInk{40, 40, 40}, kPale{225, 225, 225};
constexpr double kTickPt = 2.5, kThinPt = 0.5;

void addLine(PointPt from, PointPt to, Rgb8 colour, VectorDrawing& drawing) {
  drawing.parts.emplace_back(DrawnLine{{from, to}, kThinPt, colour, false});
}

DrawnText label(PointPt at, const std::string& text, double size_pt, TextAnchor anchor) {
  DrawnText label;
  label.at = at;
  label.text = text;
  label.size_pt = size_pt;
  label.anchor = anchor;
  return label;
}

/// Removes characters from the middle until it fits: file names differ at both ends.
void shorten(DrawnText& text, double width_pt) {
  std::string left = text.text.substr(0, text.text.size() / 2);
  std::string right = text.text.substr(left.size());
  const auto inside = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; };
  while (!left.empty() && !right.empty() && textWidthPt(text) > width_pt) {
    while (inside(left.back()) && left.size() > 1) left.pop_back();  // UTF-8: whole characters
    left.pop_back();
    do right.erase(0, 1);
    while (!right.empty() && inside(right.front()));
    text.text = left + "\xE2\x80\xA6" + right;
  }
}

}  // namespace

AxisRange AxisRange::around(double low, double high) {
  const double margin = high > low ? 0.04 * (high - low) : std::max(0.5, 0.04 * std::abs(low));
  return {low - margin, high + margin};
}

PlotAxes::PlotAxes(PointPt top_left, PointPt bottom_right, AxisRange x, AxisRange y, double font_pt)
    : top_left_(top_left), bottom_right_(bottom_right), x_(x), y_(y), font_pt_(font_pt) {}

double PlotAxes::xPt(double x) const {
  const double part = std::clamp((x - x_.low) / (x_.high - x_.low), 0.0, 1.0);
  return left() + part * (right() - left());
}

double PlotAxes::yPt(double y) const {
  const double part = std::clamp((y - y_.low) / (y_.high - y_.low), 0.0, 1.0);
  return bottom() - part * (bottom() - top());
}

void PlotAxes::drawGrid(VectorDrawing& drawing) const {
  for (const double y : niceTicks(y_.low, y_.high, 5).values)
    addLine({left(), yPt(y)}, {right(), yPt(y)}, kPale, drawing);
}

void PlotAxes::drawLeftNumbers(VectorDrawing& drawing) const {
  const Ticks ticks = niceTicks(y_.low, y_.high, 5);
  for (const double y : ticks.values) {
    addLine({left() - kTickPt, yPt(y)}, {left(), yPt(y)}, kInk, drawing);
    drawing.parts.emplace_back(label({left() - kTickPt - 1.5, yPt(y) + 0.36 * font_pt_},
                                     ticks.label(y), font_pt_, TextAnchor::kEnd));
  }
}

/// Fewer if their numbers would overlap.
Ticks PlotAxes::bottomTicks() const {
  for (int wanted = 6;; --wanted) {
    Ticks ticks = niceTicks(x_.low, x_.high, wanted);
    double widest_pt = 0;
    for (const double x : ticks.values)
      widest_pt = std::max(widest_pt,
                           textWidthPt(label({}, ticks.label(x), font_pt_, TextAnchor::kMiddle)));
    const double apart_pt =
        ticks.values.size() < 2 ? right() - left() : xPt(ticks.values[1]) - xPt(ticks.values[0]);
    if (wanted == 1 || apart_pt > widest_pt + 0.6 * font_pt_) return ticks;
  }
}

void PlotAxes::drawBottomNumbers(VectorDrawing& drawing) const {
  const Ticks ticks = bottomTicks();
  for (const double x : ticks.values) {
    addLine({xPt(x), bottom()}, {xPt(x), bottom() + kTickPt}, kInk, drawing);
    drawing.parts.emplace_back(label({xPt(x), bottom() + kTickPt + 1.1 * font_pt_}, ticks.label(x),
                                     font_pt_, TextAnchor::kMiddle));
  }
}

void PlotAxes::drawFrame(const std::string& x_label, const std::string& y_label,
                         VectorDrawing& drawing, bool x_numbers) const {
  drawLeftNumbers(drawing);
  if (x_numbers) drawBottomNumbers(drawing);
  drawing.parts.emplace_back(
      DrawnLine{{top_left_, {right(), top()}, bottom_right_, {left(), bottom()}, top_left_},
                kThinPt,
                kInk,
                false});
  drawing.parts.emplace_back(label({(left() + right()) / 2, bottom() + kTickPt + 2.6 * font_pt_},
                                   x_label, font_pt_, TextAnchor::kMiddle));
  DrawnText name =
      label({1.1 * font_pt_, (top() + bottom()) / 2}, y_label, font_pt_, TextAnchor::kMiddle);
  name.upwards = true;
  drawing.parts.emplace_back(std::move(name));
}

void PlotAxes::drawRightAxis(AxisRange range, const std::string& text,
                             VectorDrawing& drawing) const {
  const PlotAxes other(top_left_, bottom_right_, x_, range, font_pt_);
  const Ticks ticks = niceTicks(range.low, range.high, 5);
  for (const double y : ticks.values) {
    addLine({right(), other.yPt(y)}, {right() + kTickPt, other.yPt(y)}, kInk, drawing);
    drawing.parts.emplace_back(label({right() + kTickPt + 1.5, other.yPt(y) + 0.36 * font_pt_},
                                     ticks.label(y), font_pt_, TextAnchor::kStart));
  }
  DrawnText name = label({drawing.width_pt - 0.5 * font_pt_, (top() + bottom()) / 2}, text,
                         font_pt_, TextAnchor::kMiddle);
  name.upwards = true;
  drawing.parts.emplace_back(std::move(name));
}

void PlotAxes::drawCurve(const std::vector<double>& x, const std::vector<double>& y,
                         const DrawnLine& style, VectorDrawing& drawing) const {
  DrawnLine piece = style;
  const auto finishPiece = [&] {
    if (piece.points.size() == 1)  // single sample: drawn as a short line, else invisible
      piece.points = {{piece.points[0].x_pt - 1, piece.points[0].y_pt},
                      {piece.points[0].x_pt + 1, piece.points[0].y_pt}};
    if (!piece.points.empty()) drawing.parts.emplace_back(piece);
    piece.points.clear();
  };
  piece.points.clear();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (std::isfinite(x[i]) && std::isfinite(y[i]))
      piece.points.push_back(at(x[i], y[i]));
    else
      finishPiece();
  finishPiece();
}

void PlotAxes::drawBar(double middle, double half_width, double value, Rgb8 colour,
                       VectorDrawing& drawing) const {
  if (!std::isfinite(value)) return;
  drawing.parts.emplace_back(
      DrawnShape{{at(middle - half_width, 0), at(middle - half_width, value),
                  at(middle + half_width, value), at(middle + half_width, 0)},
                 colour});
}

VectorDrawing newPlotSheet(double width_mm, double height_mm) {
  VectorDrawing drawing;
  drawing.width_pt = width_mm * kPtPerMm;
  drawing.height_pt = height_mm * kPtPerMm;
  return drawing;
}

PlotAxes plotAxes(const VectorDrawing& drawing, AxisRange x, AxisRange y, double font_pt,
                  const PlotMargins& margins) {
  return PlotAxes({5.2 * font_pt, margins.above * font_pt},
                  {drawing.width_pt - margins.right * font_pt, drawing.height_pt - 3.6 * font_pt},
                  x, y, font_pt);
}

void drawPlotTitle(const std::string& title, const PlotAxes& axes, double font_pt,
                   VectorDrawing& drawing) {
  DrawnText text = label({axes.left(), 1.4 * font_pt}, title, font_pt, TextAnchor::kStart);
  text.bold = true;
  shorten(text, drawing.width_pt - axes.left());
  drawing.parts.emplace_back(std::move(text));
}

void drawLegend(const std::vector<LegendEntry>& entries, PointPt left_middle, double font_pt,
                VectorDrawing& drawing) {
  double x = left_middle.x_pt;
  const double y = left_middle.y_pt, sample_pt = 2 * font_pt;
  for (const LegendEntry& entry : entries) {
    if (entry.filled)
      drawing.parts.emplace_back(DrawnShape{{{x, y - 0.4 * font_pt},
                                             {x + sample_pt, y - 0.4 * font_pt},
                                             {x + sample_pt, y + 0.4 * font_pt},
                                             {x, y + 0.4 * font_pt}},
                                            entry.colour});
    else if (entry.dotted)
      drawing.parts.emplace_back(DrawnDots{
          {{x + 0.4 * font_pt, y}, {x + font_pt, y}, {x + 1.6 * font_pt, y}}, 1.6, entry.colour});
    else
      drawing.parts.emplace_back(
          DrawnLine{{{x, y}, {x + sample_pt, y}}, 1.2, entry.colour, entry.dashed});
    x += sample_pt + 0.4 * font_pt;
    const DrawnText meaning =
        label({x, y + 0.36 * font_pt}, entry.meaning, font_pt, TextAnchor::kStart);
    x += textWidthPt(meaning) + font_pt;
    drawing.parts.emplace_back(meaning);
  }
}

}  // namespace softscope
