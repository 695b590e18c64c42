// toolkit/figures/draw_figure.h: CT, reference, model and scans, or whole runs, as one figure.
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
  FigureOptions page;                  // files, style, planes
  std::string kind = "four";           // or of a run: frames, series, compare, matches
  std::string run;                     // folder; excludes ct and test
  std::string ct, reference, test;     // files; of a run `reference` is its sequence
  std::vector<std::string> surfaces;   // further surfaces or models
  std::vector<std::string> scans;      // points, drawn in red
  SurfaceFitOptions fit;               // the test to the reference
  ErrorColourOptions errors;           // of the test from the reference
  std::string other;                   // of kind compare: the second run
  std::vector<std::string> names;      // of kind compare: of both runs
  std::vector<int> frames;             // of the panels, rising; empty: up to four, evenly spread
  int frame = -1;                      // of a run; -1: the last one that can be judged
  bool observed_only = false;          // of a run: errors of the points that the scope sees now
  std::optional<Eigen::Vector3d> eye;  // direction that the 3-D panel is seen from
  int columns = 0;                     // 1, 2 or 4 panels in a row; 0: as the style has it

  /// Throws OptionError.
  void validate() const;
};

struct DrawnFigure {
  VectorDrawing drawing;
  FactSheet::Json record;  // beside the figure
  std::vector<std::string> warnings;
};

/// Writes nothing: writeFigure() does. Throws OptionError, InputError, BackendError.
DrawnFigure drawFigure(const FigureRequest& request);

}  // namespace softscope
