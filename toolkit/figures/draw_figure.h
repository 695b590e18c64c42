// toolkit/figures/draw_figure.h: figure of CT, reference, model and scans, or of whole runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "toolkit/comparison/surface_fit.h"
#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/figures/figure_options.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/drawing/vector_drawing.h"

namespace softscope {

struct FigureRequest {
  FigureOptions page;                  // output files, style, planes
  std::string kind = "four";           // or for a run: frames, series, compare, matches
  std::string run;                     // folder; excludes ct and test
  std::string ct, reference, test;     // files; for a run `reference` is its sequence
  std::vector<std::string> surfaces;   // additional surfaces or models
  std::vector<std::string> scans;      // points, drawn in red
  SurfaceFitOptions fit;               // alignment of the test to the reference
  ErrorColourOptions errors;           // distance of the test to the reference
  std::string other;                   // for kind compare: second run
  std::vector<std::string> names;      // for kind compare: names of both runs
  std::vector<int> frames;             // of the panels, ascending; empty: up to four, evenly spread
  int frame = -1;                      // frame of a run; -1: the last frame with a truth
  bool observed_only = false;          // for a run: errors of currently visible points only
  std::optional<Eigen::Vector3d> eye;  // view direction of the 3-D panel
  int columns = 0;                     // 1, 2 or 4 panels per row; 0: from the style

  /// Throws OptionError.
  void validate() const;
};

struct DrawnFigure {
  VectorDrawing drawing;
  FactSheet::Json record;  // written next to the figure
  std::vector<std::string> warnings;
};

/// Writes no file: see writeFigure(). Throws OptionError, InputError, BackendError.
DrawnFigure drawFigure(const FigureRequest& request);

}  // namespace softscope
