// src/features/opencv_matchers.h: OpenCV's matchers, for comparison.
#pragma once

#include <memory>

#include "features/matcher.h"

namespace softscope {

/// SIFT key points with cross-check and ratio test within
/// the search radius; sub-pixel positions of SIFT.
std::unique_ptr<FeatureMatcher> makeSiftMatcher(const MatcherOptions& options);

/// Dense inverse search flow (Kroeger et al. 2016) at one pixel per square of
/// spacing_px, then the common refinement if selected. No search radius, no ratio test.
std::unique_ptr<FeatureMatcher> makeFlowMatcher(const MatcherOptions& options);

}  // namespace softscope
