// src/features/subpixel_match.h: sub-pixel refinement of matches, with standard errors.
#pragma once

#include <vector>

#include "features/matcher.h"

namespace softscope {

/// Moves live_px of each match such that the live image around it matches the model
/// image around model_px, invariant to gain and offset of the brightness: inverse
/// compositional Gauss-Newton (Baker and Matthews 2004) with mean and contrast
/// projected out (Hager and Belhumeur 1998). With an anchor image, its window is tried
/// first, so that tissue of unchanged appearance does not drift: docs/matching.md, 4.
/// Sets sigma_px and similarity; drops matches rejected by the options, and those
/// whose window exceeds an image or is mostly ignored. Keeps the order.
std::vector<PixelMatch> refineMatches(const MatchPicture& model, const MatchPicture& live,
                                      const std::vector<PixelMatch>& rough,
                                      const SubpixelOptions& options);

}  // namespace softscope
