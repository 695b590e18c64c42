// toolkit/evaluation/surface_error_map.h: colours of a figure from measured distances.
#pragma once

#include <string>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/scenes/panel_grid.h"

namespace softscope {

/// Options of the colours.
struct ErrorColourOptions {
  std::string kind = "absolute";  // or "signed" or "none"
  double range_mm = 0;            // 0: a round number, at least the 95th percentile

  /// Throws OptionError.
  void validate() const;
};

struct SurfaceErrorMap {
  std::vector<double> each_mm;  // one per vertex; NaN = not observed, or without a sign
  ErrorColours colours;
  ColourBarText bar;
  FactSheet::Json json;  // kind, range, statistics

  /// Adds the colours and their bar to a figure.
  void explainIn(FigureFoot& foot) const;
};

/// From distances and signed distances, one per vertex.
SurfaceErrorMap colourErrors(const std::vector<double>& distance_mm,
                             const std::vector<double>& signed_mm,
                             const ErrorColourOptions& options);
SurfaceErrorMap colourErrors(const std::vector<ClosestPoint>& closest,
                             const ErrorColourOptions& options);

}  // namespace softscope
