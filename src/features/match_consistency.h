// src/features/match_consistency.h: consistency test of a match with its neighbours.
#pragma once

#include <vector>

#include "features/matcher.h"

namespace softscope {

/// Keeps matches of which at least `options.kMinShare` of the others within reach_px (and one at
/// least) moved the same way to agree_px; two surfaces that slide past each other both stay. Keeps
/// the order.
std::vector<PixelMatch> keepConsistent(const std::vector<PixelMatch>& matches,
                                       const ConsistencyOptions& options);

}  // namespace softscope
