// toolkit/evaluation/surface_error_map.h: colours of a figure from measured distances.
#pragma once

#include <string>
#include <vector>

#include "eval/distance/triangle_tree.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/scenes/panel_grid.h"

namespace softscope {

/// What the user asked for.
struct ErrorColourOptions {
  std::string kind = "absolute";  // or "signed" or "none"
  double range_mm = 0;            // 0: a round number, not below the 95th percentile

  /// Throws OptionError.
  void validate() const;
};

struct SurfaceErrorMap {
  std::vector<double> each_mm;  // one a vertex; NaN = not observed, or no side is outside
  ErrorColours colours;
  ColourBarText bar;
  FactSheet::Json json;  // kind, range, statistics

  /// Gives the colours and their bar to a figure.
  void explainIn(FigureFoot& foot) const;
};

/// Of distances and signed distances, one a vertex.
SurfaceErrorMap colourErrors(const std::vector<double>& distance_mm,
                             const std::vector<double>& signed_mm,
                             const ErrorColourOptions& options);
SurfaceErrorMap colourErrors(const std::vector<ClosestPoint>& closest,
                             const ErrorColourOptions& options);

}  // namespace softscope
