// toolkit/figures/figure_matches.h: matches of two matchers between the model and a new image.
#pragma once

#include "toolkit/figures/figure_kinds.h"

namespace softscope {

/// The run's model, drawn into the camera that it was last seen by, against the rectified left
/// image of a frame after it: dense SURF above, SIFT below, with the run's own settings and the
/// pipeline's own functions. `options.frames`: that frame; empty: the last one that comes right
/// after a saved model. `options.sequence`: where the run's images are. Throws InputError,
/// OptionError.
RunFigure drawMatchFigure(const RunFigureOptions& options, SceneInputs& inputs);

}  // namespace softscope
