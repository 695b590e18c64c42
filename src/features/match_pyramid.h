// src/features/match_pyramid.h: image pyramid of the model view and the live image.
#pragma once

#include <vector>

#include "features/matcher.h"

namespace softscope {

/// Minimum side of the coarsest images: smaller ones have too few descriptors.
constexpr int kLeastMatchSidePx = 96;

/// One resolution of both images.
struct MatchLevel {
  MatchPicture model, live;
};

/// Half as wide and high. A pixel is ignored if one of its four is.
MatchPicture halved(const MatchPicture& fine);

/// Level 0 is the full resolution, each further level half of it, down
/// to the last one with a shorter side of at least `least_side_px`.
std::vector<MatchLevel> matchPyramid(const MatchPicture& model, const MatchPicture& live,
                                     int least_side_px);

/// Matches of a level in the pixels of the next finer one: p -> 2 p + 1/2.
std::vector<PixelMatch> toFinerLevel(std::vector<PixelMatch> matches);

}  // namespace softscope
