// src/features/opencv_matchers.h: OpenCV's matchers, for comparison.
#pragma once

#include <memory>

#include "features/matcher.h"

namespace softscope {

/// SIFT key points with mutual and ratio tests within the search radius; SIFT's own sub-pixel
/// places.
std::unique_ptr<FeatureMatcher> makeSiftMatcher(const MatcherOptions& options);

/// Dense inverse search flow (Kroeger et al. 2016) at one pixel in each square of spacing_px, then
/// the common refinement where the options want one. No search radius, no ratio test.
std::unique_ptr<FeatureMatcher> makeFlowMatcher(const MatcherOptions& options);

}  // namespace softscope
