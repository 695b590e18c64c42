// vtk_views/plots/plot_axes.h: a frame with numbers at its sides, inside a drawing.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/nice_ticks.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// What one side of the frame spans.
struct AxisRange {
  double low = 0, high = 1;

  /// A little wider than [low, high], so that a curve doesn't touch the frame.
  static AxisRange around(double low, double high);
};

/// The frame of one plot: where values lie on the page.
class PlotAxes {
 public:
  PlotAxes(PointPt top_left, PointPt bottom_right, AxisRange x, AxisRange y, double font_pt);

  double xPt(double x) const;
  /// Values beyond the axis are drawn at its end.
  double yPt(double y) const;
  PointPt at(double x, double y) const { return {xPt(x), yPt(y)}; }
  double left() const { return top_left_.x_pt; }
  double right() const { return bottom_right_.x_pt; }
  double top() const { return top_left_.y_pt; }
  double bottom() const { return bottom_right_.y_pt; }

  /// Pale lines across at the ticks of y; under everything else.
  void drawGrid(VectorDrawing& drawing) const;
  /// Frame, ticks, numbers and names of both axes; over everything else. Without `x_numbers` the
  /// caller writes what stands below.
  void drawFrame(const std::string& x_label, const std::string& y_label, VectorDrawing& drawing,
                 bool x_numbers = true) const;
  /// Numbers of a second y axis on the right, which spans `range`.
  void drawRightAxis(AxisRange range, const std::string& label, VectorDrawing& drawing) const;

  /// A line through the points, broken where x or y is NaN.
  void drawCurve(const std::vector<double>& x, const std::vector<double>& y, const DrawnLine& style,
                 VectorDrawing& drawing) const;

  /// From 0 to `value`, which may be NaN: then nothing.
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

/// Nothing but its size.
VectorDrawing newPlotSheet(double width_mm, double height_mm);

/// Room for title and legend above, numbers and names at the sides, in heights of letters.
struct PlotMargins {
  double above = 3.4, right = 1.2;
};

/// The frame that a sheet with one plot has room for.
PlotAxes plotAxes(const VectorDrawing& drawing, AxisRange x, AxisRange y, double font_pt,
                  const PlotMargins& margins);

/// Bold, at the top; a long one loses letters in its middle.
void drawPlotTitle(const std::string& title, const PlotAxes& axes, double font_pt,
                   VectorDrawing& drawing);

/// A sample of a line or shape and its meaning.
struct LegendEntry {
  std::string meaning;
  Rgb8 colour;
  bool filled = false;
  bool dashed = false;
  bool dotted = false;  // a few points
};

/// Entries side by side, from `left_middle` on.
void drawLegend(const std::vector<LegendEntry>& entries, PointPt left_middle, double font_pt,
                VectorDrawing& drawing);

}  // namespace softscope
