// src/features/match_consistency.h: consistency test of a match with its neighbours.
#pragma once

#include <vector>

#include "features/matcher.h"

namespace softscope {

/// Keeps matches with consistent neighbours: at least `options.kMinShare` of the
/// matches within reach_px (and at least one) have the same motion up to agree_px;
/// two surfaces that slide past each other are both kept. Keeps the order.
std::vector<PixelMatch> keepConsistent(const std::vector<PixelMatch>& matches,
                                       const ConsistencyOptions& options);

}  // namespace softscope
