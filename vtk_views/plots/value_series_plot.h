// vtk_views/plots/value_series_plot.h: one value over time.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/plots/series_plot.h"

namespace softscope {

struct ValueSeriesData {
  std::string x_label, y_label;
  std::vector<double> x, y;  // x ascending; NaN is a gap
};

/// Line with one dot per value; the axis covers the values.
/// Throws Error without values, or for different lengths.
VectorDrawing drawValueSeries(const ValueSeriesData& data, const PlotStyle& style = {});

}  // namespace softscope
