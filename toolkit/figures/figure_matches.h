// toolkit/figures/figure_matches.h: matches of two matchers between the model and a new image.
#pragma once

#include "toolkit/figures/figure_kinds.h"

namespace softscope {

/// Matches between the model, rendered from its last pose, and the rectified
/// left image of the next frame: dense SURF above, SIFT below, with the
/// settings of the run and the functions of the pipeline. `options.frames`:
/// that frame; empty: the last frame directly after a saved model.
/// `options.sequence`: images of the run. Throws InputError, OptionError.
RunFigure drawMatchFigure(const RunFigureOptions& options, SceneInputs& inputs);

}  // namespace softscope
