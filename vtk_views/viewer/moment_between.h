// vtk_views/viewer/moment_between.h: interpolation between two saved models.
#pragma once

#include <memory>

#include "vtk_views/viewer/view_controls.h"

namespace softscope {

/// Interpolation at `share` (0 to 1) between two models: points move with nearby
/// nodes of the warp, which keep their numbers; nodes and camera position move
/// linearly, the camera orientation evenly. Colours, weights and errors are those of
/// `from`: no values are measured between models. Without nodes points do not move.
ViewMoment momentBetween(const ViewMoment& from, const ViewMoment& to, double share);

/// Model at the playback time, interpolated during
/// playback. Throws InputError for unreadable files.
std::shared_ptr<const ViewMoment> shownMoment(ViewSource& source, const Playback& playback,
                                              bool with_errors);

}  // namespace softscope
