// vtk_views/plots/series_plot.h: errors over time, and how they are spread.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

/// Column width and size of letters of a figure.
struct PlotStyle {
  double width_mm = 89;  // one column
  double height_mm = 58;
  double font_pt = 7;
};

/// One value a moment; NaN leaves a gap.
struct ErrorSeriesData {
  std::string title;
  std::string time_label = "time [s]";
  std::string error_label = "distance to the surface [mm]";
  std::vector<double> times;  // rising
  std::vector<double> mean, median, p95;
};

/// Mean and median as lines over the band up to the 95th percentile; the axis begins at 0.
/// Throws Error where the lengths differ or there is no finite value.
VectorDrawing drawErrorSeries(const ErrorSeriesData& data, const PlotStyle& style = {});

/// Counted elsewhere: docs/evaluation.md.
struct ErrorHistogramData {
  std::string title;
  std::string error_label = "distance to the surface [mm]";
  double low = 0, high = 1;        // of the bins together
  std::vector<double> shares;      // of all values, a bin; what lies beyond is in none
  std::vector<double> cumulative;  // share of all values below each bin's end
  double share_beyond = 0;         // above `high`: named in the figure
  double median = 0, p95 = 0;      // marked where they are finite
};

/// Bars with their axis on the left, the cumulative share as a line with its axis on the right.
/// Throws Error where the lengths differ or there is no bin.
VectorDrawing drawErrorHistogram(const ErrorHistogramData& data, const PlotStyle& style = {});

}  // namespace softscope
