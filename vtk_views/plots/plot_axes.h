// vtk_views/plots/plot_axes.h: axes of a plot inside a drawing.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/nice_ticks.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Range of one axis.
struct AxisRange {
  double low = 0, high = 1;

  /// [low, high] with a margin.
  static AxisRange around(double low, double high);
};

/// Mapping of values to the page for one plot.
class PlotAxes {
 public:
  PlotAxes(PointPt top_left, PointPt bottom_right, AxisRange x, AxisRange y, double font_pt);

  double xPt(double x) const;
  /// Values outside of the range are clamped.
  double yPt(double y) const;
  PointPt at(double x, double y) const { return {xPt(x), yPt(y)}; }
  double left() const { return top_left_.x_pt; }
  double right() const { return bottom_right_.x_pt; }
  double top() const { return top_left_.y_pt; }
  double bottom() const { return bottom_right_.y_pt; }

  /// Pale horizontal lines at the ticks of y; drawn first.
  void drawGrid(VectorDrawing& drawing) const;
  /// Frame, ticks, numbers and labels of both axes; drawn last.
  /// Without `x_numbers` the caller draws the labels below.
  void drawFrame(const std::string& x_label, const std::string& y_label, VectorDrawing& drawing,
                 bool x_numbers = true) const;
  /// Numbers of a second y axis on the right, with range `range`.
  void drawRightAxis(AxisRange range, const std::string& label, VectorDrawing& drawing) const;

  /// Polyline with gaps at NaN.
  void drawCurve(const std::vector<double>& x, const std::vector<double>& y, const DrawnLine& style,
                 VectorDrawing& drawing) const;

  /// Bar from 0 to `value`; nothing for NaN.
  void drawBar(double middle, double half_width, double value, Rgb8 colour,
               VectorDrawing& drawing) const;

 private:
  void drawLeftNumbers(VectorDrawing& drawing) const;
  Ticks bottomTicks() const;
  void drawBottomNumbers(VectorDrawing& drawing) const;

  PointPt top_left_, bottom_right_;
  AxisRange x_, y_;
  double font_pt_;
};

/// Empty drawing of this size.
VectorDrawing newPlotSheet(double width_mm, double height_mm);

/// Space for title, legend, numbers and labels, in units of the font size.
struct PlotMargins {
  double above = 3.4, right = 1.2;
};

/// Axes that fill a sheet with one plot.
PlotAxes plotAxes(const VectorDrawing& drawing, AxisRange x, AxisRange y, double font_pt,
                  const PlotMargins& margins);

/// Bold, at the top; a long title is shortened in its middle.
void drawPlotTitle(const std::string& title, const PlotAxes& axes, double font_pt,
                   VectorDrawing& drawing);

/// Sample of a line or shape with its meaning.
struct LegendEntry {
  std::string meaning;
  Rgb8 colour;
  bool filled = false;
  bool dashed = false;
  bool dotted = false;  // dotted line
};

/// Entries side by side from `left_middle`.
void drawLegend(const std::vector<LegendEntry>& entries, PointPt left_middle, double font_pt,
                VectorDrawing& drawing);

}  // namespace softscope
