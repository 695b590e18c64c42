// vtk_views/plots/level_plot.h: an error against how hard a case was, or side by side for several
// cases.
#pragma once

#include <string>
#include <vector>

#include "vtk_views/drawing/vector_drawing.h"
#include "vtk_views/plots/series_plot.h"

namespace softscope {

/// One curve; values are in the order of `levels`.
struct LevelCurve {
  std::string name;            // for the legend; may be empty where there is one curve
  std::vector<double> levels;  // rising
  std::vector<double> mean;    // NaN: lost, marked by a cross at the top of the frame
  std::vector<double> p95;     // drawn dashed; NaN leaves a gap
};

struct LevelPlotData {
  std::string title, level_label, error_label;
  std::vector<LevelCurve> curves;
  double limit = 0;  // a line across; 0: none
};

/// Mean as a line with a dot a level, P95 dashed above it. The axis begins at 0 and ends at three
/// limits where values go beyond. Throws Error where lengths differ or there is no curve.
VectorDrawing drawLevels(const LevelPlotData& data, const PlotStyle& style = {});

/// One bar a case: mean inside a wider one up to P95, and a diamond at a published value.
struct CaseBar {
  std::string name;
  double mean = 0, p95 = 0, published = 0;  // NaN: not there
};

struct CaseBarsData {
  std::string title, error_label, published_label;
  std::vector<CaseBar> bars;
};

/// Names stand upright below the bars. Throws Error where there is no bar.
VectorDrawing drawCaseBars(const CaseBarsData& data, const PlotStyle& style = {});

}  // namespace softscope
