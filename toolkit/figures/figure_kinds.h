// toolkit/figures/figure_kinds.h: figures of whole runs: models at frames, errors over time, two
// runs.
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
  std::string run, other;          // folders that reconstruct wrote; `other` for "compare"
  std::vector<std::string> names;  // of run and other; empty: what tells their folders apart
  std::string sequence;            // with the truth; may be empty for "frames" and "compare"
  std::vector<int> frames;         // of the panels; empty: up to four, evenly spread
  bool observed_only = false;      // points that the scope doesn't see then are grey
  ErrorColourOptions errors;
  Eigen::Vector3d eye{0, 0, 0};  // zeros: the kind's own
  PanelOptions panels;           // style, columns; width 0: as the models need it
};

struct RunFigure {
  VectorDrawing drawing;
  FactSheet::Json record;
};

/// frames: the coloured model at some frames, in the world, from one place. series: error maps at
/// some frames with one range, and under them mean, median and P95 of all frames. compare: two runs
/// of one sequence at one frame, in colour, and with the truth their error maps with one range.
/// What is read is noted in `inputs`. Throws InputError, OptionError, BackendError.
RunFigure drawRunFigure(const RunFigureOptions& options, SceneInputs& inputs);

}  // namespace softscope
