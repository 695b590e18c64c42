// src/features/subpixel_match.h: matches to hundredths of a pixel, with their standard error.
#pragma once

#include <vector>

#include "features/matcher.h"

namespace softscope {

/// Moves live_px of each match so that the live image around it looks like the model image
/// around model_px, whatever the gain and offset of the brightness: inverse compositional
/// Gauss-Newton (Baker and Matthews 2004) with mean and contrast projected out (Hager and
/// Belhumeur 1998). Where the model image has an anchor, its window is tried first, so that the
/// places of tissue that still looks as it did don't drift: docs/matching.md, 4. Sets sigma_px and
/// similarity; drops matches that the options refuse, and those whose window leaves an image or is
/// mostly ignored. Keeps the order.
std::vector<PixelMatch> refineMatches(const MatchPicture& model, const MatchPicture& live,
                                      const std::vector<PixelMatch>& rough,
                                      const SubpixelOptions& options);

}  // namespace softscope
