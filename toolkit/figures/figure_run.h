// toolkit/figures/figure_run.h: a run's model at one moment beside the truth, as a scene.
#pragma once

#include <string>

#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/figures/scene_inputs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct RunMomentOptions {
  std::string run, sequence;   // folders
  int frame = -1;              // -1: the last one with a model and a true mesh
  bool observed_only = false;  // points that the scope doesn't see now count as not observed
  ErrorColourOptions errors;
};

/// Adds the true surface, the model with its errors, and the tissue that the scope sees now (the
/// scan, in red), all in the left camera's frame of that moment: a motion of the whole scene can be
/// tissue or scope, so they are compared as the camera sees them. Explains the errors in `foot`,
/// and returns what the record says of run, frame and errors. Throws InputError, OptionError.
FactSheet::Json addRunMoment(const RunMomentOptions& options, SceneInputs& inputs,
                             FigureFoot& foot);

}  // namespace softscope
