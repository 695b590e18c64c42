// vtk_views/viewer/moment_between.h: interpolation between two saved models.
#pragma once

#include <memory>

#include "vtk_views/viewer/view_controls.h"

namespace softscope {

/// `share` (0 to 1) of the way from a moment to the next one: points move with the nodes of the
/// warp near them, which keep their numbers, nodes and scope in straight lines, the scope's
/// direction evenly. Colours, weights and errors stay those of `from`: nothing is measured between
/// models. Without nodes points stay.
ViewMoment momentBetween(const ViewMoment& from, const ViewMoment& to, double share);

/// The moment that playback is at, between two models where it plays. Throws InputError where
/// files can't be read.
std::shared_ptr<const ViewMoment> shownMoment(ViewSource& source, const Playback& playback,
                                              bool with_errors);

}  // namespace softscope
