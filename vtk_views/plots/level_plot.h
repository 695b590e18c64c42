// vtk_views/plots/level_plot.h: error over the
// level of difficulty, or bars for several cases.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// Curve; values in the order of `levels`.
struct LevelCurve {
  std::string name;            // for the legend; may be empty for a single curve
  std::vector<double> levels;  // ascending
  std::vector<double> mean;    // NaN: lost, drawn as a cross at the top of the frame
  std::vector<double> p95;     // dashed; NaN is a gap
};

struct LevelPlotData {
  std::string title, level_label, error_label;
  std::vector<LevelCurve> curves;
  double limit = 0;  // horizontal line; 0: none
};

/// Mean as a line with one dot per level, P95 dashed. The axis begins at 0 and ends at
/// three limits if values exceed that. Throws Error for different lengths or no curve.
VectorDrawing drawLevels(const LevelPlotData& data, const PlotStyle& style = {});

/// One bar per case: mean inside a wider bar up to P95; published value as a diamond.
struct CaseBar {
  std::string name;
  double mean = 0, p95 = 0, published = 0;  // NaN: missing
};

struct CaseBarsData {
  std::string title, error_label, published_label;
  std::vector<CaseBar> bars;
};

/// Names are vertical below the bars. Throws Error without a bar.
VectorDrawing drawCaseBars(const CaseBarsData& data, const PlotStyle& style = {});

}  // namespace softscope
