// toolkit/figures/figure_run.h: scene of one model of a run with the truth of its frame.
#pragma once

#include <string>

#include "toolkit/evaluation/surface_error_map.h"
#include "toolkit/figures/scene_inputs.h"
#include "toolkit/record/fact_sheet.h"

namespace softscope {

struct RunMomentOptions {
  std::string run, sequence;   // folders
  int frame = -1;              // -1: the last frame with a model and a true mesh
  bool observed_only = false;  // currently invisible points count as not observed
  ErrorColourOptions errors;
};

/// Adds the true surface, the model with its errors, and the visible tissue (scan, red),
/// all in the left camera frame of that time: a motion of the whole scene can be due to
/// tissue or scope, so they are compared in camera coordinates. Adds the colour bar to
/// `foot` and returns run, frame and errors for the record. Throws InputError, OptionError.
FactSheet::Json addRunMoment(const RunMomentOptions& options, SceneInputs& inputs,
                             FigureFoot& foot);

}  // namespace softscope
