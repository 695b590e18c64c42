// vtk_views/plots/value_series_plot.h: one value over time.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/plots/series_plot.h"

namespace softscope {

struct ValueSeriesData {
  std::string x_label, y_label;
  std::vector<double> x, y;  // x rising; NaN leaves a gap
};

/// A line with a dot a value; the axis spans the values. Throws Error where there is none, or the
/// lengths differ.
VectorDrawing drawValueSeries(const ValueSeriesData& data, const PlotStyle& style = {});

}  // namespace softscope
