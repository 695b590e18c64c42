// vtk_views/plots/series_plot.h: errors over time, and their histogram.
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

/// One value per frame; NaN is a gap.
struct ErrorSeriesData {
  std::string title;
  std::string time_label = "time [s]";
  std::string error_label = "distance to the surface [mm]";
  std::vector<double> times;  // ascending
  std::vector<double> mean, median, p95;
};

/// Mean and median as lines over a band up to the 95th percentile; the axis
/// begins at 0. Throws Error for different lengths or no finite value.
VectorDrawing drawErrorSeries(const ErrorSeriesData& data, const PlotStyle& style = {});

/// Computed elsewhere: docs/evaluation.md.
struct ErrorHistogramData {
  std::string title;
  std::string error_label = "distance to the surface [mm]";
  double low = 0, high = 1;        // range of all bins
  std::vector<double> shares;      // share of all values per bin, without values outside of it
  std::vector<double> cumulative;  // share of all values below the end of each bin
  double share_beyond = 0;         // above `high`; stated in the figure
  double median = 0, p95 = 0;      // drawn if finite
};

/// Bars with the axis on the left, cumulative share as a line with the
/// axis on the right. Throws Error for different lengths or no bin.
VectorDrawing drawErrorHistogram(const ErrorHistogramData& data, const PlotStyle& style = {});

}  // namespace softscope
