// vtk_views/drawing/error_colours.cpp: colour by value, colour bar of thin strips.
#include "vtk_views/drawing/error_colours.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "vtk_views/drawing/colour_map.h"
#include "vtk_views/drawing/nice_ticks.h"

namespace softscope {
namespace {

constexpr int kStrips = 128;
constexpr double kBarHeight = 0.9, kHeight = 3.7, kTip = 0.8;  // in units of the font size

struct Bar {
  double left, right, top, bottom;

  double x(double share) const { return left + share * (right - left); }
};

void drawStrips(const ErrorColours& colours, const Bar& bar, VectorDrawing& drawing) {
  ColourImage strips(kStrips, 1);
  for (int i = 0; i < kStrips; ++i) {
    const double share = (i + 0.5) / kStrips;
    strips.at(i, 0) =
        colours.colour(colours.low_mm() + share * (colours.limit_mm - colours.low_mm()));
  }
  drawing.parts.emplace_back(DrawnPicture{{bar.left, bar.top}, {bar.right, bar.bottom}, strips});
  drawing.parts.emplace_back(DrawnLine{{{bar.left, bar.top},
                                        {bar.right, bar.top},
                                        {bar.right, bar.bottom},
                                        {bar.left, bar.bottom},
                                        {bar.left, bar.top}},
                                       0.4,
                                       {60, 60, 60}});
}

void drawArrows(const ErrorColours& colours, const ColourBarText& text, const Bar& bar,
                double tip_pt, VectorDrawing& drawing) {
  const double middle = (bar.top + bar.bottom) / 2;
  if (text.any_above)
    drawing.parts.emplace_back(
        DrawnShape{{{bar.right, bar.top}, {bar.right + tip_pt, middle}, {bar.right, bar.bottom}},
                   colours.colour(colours.limit_mm)});
  if (text.any_below)
    drawing.parts.emplace_back(
        DrawnShape{{{bar.left, bar.top}, {bar.left - tip_pt, middle}, {bar.left, bar.bottom}},
                   colours.colour(colours.low_mm())});
}

void drawNumbers(const ErrorColours& colours, const std::string& label, const Bar& bar,
                 double font_pt, VectorDrawing& drawing) {
  const Ticks ticks = niceTicks(colours.low_mm(), colours.limit_mm, 4);
  DrawnText text;
  text.size_pt = font_pt;
  text.anchor = TextAnchor::kMiddle;
  for (const double value : ticks.values) {
    const double x = bar.x((value - colours.low_mm()) / (colours.limit_mm - colours.low_mm()));
    drawing.parts.emplace_back(
        DrawnLine{{{x, bar.bottom}, {x, bar.bottom + 0.25 * font_pt}}, 0.5, {60, 60, 60}});
    text.at = {x, bar.bottom + 1.15 * font_pt};
    text.text = ticks.label(value);
    drawing.parts.emplace_back(text);
  }
  text.at = {bar.x(0.5), bar.bottom + 2.35 * font_pt};
  text.text = label;
  drawing.parts.emplace_back(text);
}

double widestNumberPt(const ErrorColours& colours, double font_pt) {
  const Ticks ticks = niceTicks(colours.low_mm(), colours.limit_mm, 4);
  double widest_pt = 0;
  for (const double value : ticks.values) {
    DrawnText text;
    text.text = ticks.label(value);
    text.size_pt = font_pt;
    widest_pt = std::max(widest_pt, textWidthPt(text));
  }
  return widest_pt;
}

/// Grey patch at the right end; returns its width.
double drawMissing(const std::string& meaning, PointPt top_right, double font_pt,
                   VectorDrawing& drawing) {
  DrawnText text;
  text.text = meaning;
  text.size_pt = font_pt;
  text.anchor = TextAnchor::kEnd;
  const double width_pt = textWidthPt(text), side = kBarHeight * font_pt;
  text.at = {top_right.x_pt, top_right.y_pt + 0.85 * font_pt};
  drawing.parts.emplace_back(text);
  const double right = top_right.x_pt - width_pt - 0.4 * font_pt, top = top_right.y_pt;
  drawing.parts.emplace_back(DrawnShape{
      {{right - side, top}, {right, top}, {right, top + side}, {right - side, top + side}},
      kUnmeasuredGrey});
  return width_pt + 0.4 * font_pt + side;
}

}  // namespace

Rgb8 blueWhiteRed(double position) {
  constexpr std::array<Rgb8, 4> kBlues{
      {{247, 247, 247}, {146, 197, 222}, {67, 147, 195}, {5, 48, 97}}};
  constexpr std::array<Rgb8, 4> kReds{
      {{247, 247, 247}, {244, 165, 130}, {214, 96, 77}, {103, 0, 31}}};
  const auto& side = position < 0 ? kBlues : kReds;
  const double place = std::min(std::abs(position), 1.0) * 3;
  const auto below = static_cast<std::size_t>(std::min(place, 2.0));
  const double part = place - static_cast<double>(below);
  return blend(side[below], side[below + 1], part);
}

Rgb8 ErrorColours::colour(double error_mm) const {
  if (std::isnan(error_mm)) return kUnmeasuredGrey;
  return with_sign ? blueWhiteRed(error_mm / limit_mm) : viridis(error_mm / limit_mm);
}

double colourBarHeightPt(double font_pt) { return kHeight * font_pt; }

double drawColourBar(const ErrorColours& colours, const ColourBarText& text, PointPt top_left,
                     double width_pt, double font_pt, VectorDrawing& drawing) {
  if (!(colours.limit_mm > 0)) throw Error("colour bar: its range must be above 0");
  double right = top_left.x_pt + width_pt;
  if (text.any_missing)
    right -= drawMissing(text.missing, {right, top_left.y_pt}, font_pt, drawing) + 1.5 * font_pt;
  const double tip_pt = kTip * font_pt;
  const double inset_pt = std::max(tip_pt, 0.55 * widestNumberPt(colours, font_pt));
  const Bar bar{top_left.x_pt + inset_pt, right - inset_pt, top_left.y_pt,
                top_left.y_pt + kBarHeight * font_pt};
  drawStrips(colours, bar, drawing);
  drawArrows(colours, text, bar, tip_pt, drawing);
  drawNumbers(colours, text.label, bar, font_pt, drawing);
  return colourBarHeightPt(font_pt);
}

}  // namespace softscope
