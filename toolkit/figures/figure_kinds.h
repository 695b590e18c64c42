// toolkit/figures/figure_kinds.h: figures of whole runs: models
// at selected frames, errors over time, comparison of two runs.
#pragma once

#include <string>
#include <vector>

#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/figures/scene_inputs.h"
#include "toolkit/record/fact_sheet.h"
#include "vtk_views/scenes/four_panels.h"

namespace softscope {

struct RunFigureOptions {
  std::string kind;                // "frames", "series" or "compare"
  std::string run, other;          // folders written by reconstruct; `other` for "compare"
  std::vector<std::string> names;  // of run and other; empty: the distinct parts of their paths
  std::string sequence;            // with ground truth; optional for "frames" and "compare"
  std::vector<int> frames;         // of the panels; empty: up to four, evenly spread
  bool observed_only = false;      // currently invisible points are grey
  ErrorColourOptions errors;
  Eigen::Vector3d eye{0, 0, 0};  // zero: default of the kind
  PanelOptions panels;           // style, columns; width 0: according to the models
};

struct RunFigure {
  VectorDrawing drawing;
  FactSheet::Json record;
};

/// frames: coloured model at selected frames, in the world, from one viewpoint. series: error maps
/// at selected frames with a common range, above mean, median and P95 of all frames. compare: two
/// runs of one sequence at one frame, in colour, and their error maps with a common range if there
/// is truth. Input files are recorded in `inputs`. Throws InputError, OptionError, BackendError.
RunFigure drawRunFigure(const RunFigureOptions& options, SceneInputs& inputs);

}  // namespace softscope
