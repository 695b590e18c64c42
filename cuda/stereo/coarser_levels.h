// cuda/stereo/coarser_levels.h: how many levels of the pyramid a frame needs.
#pragma once

#include "cuda/stereo/stereo_layout.h"

namespace softscope::cuda {

/// Share of the matchable pixels without a disparity.
inline double unmatchedShare(const OpenShare& share) {
  return share.matchable == 0 ? 1 : static_cast<double>(share.unmatched) / share.matchable;
}

/// Runs coarser levels while they are useful, and fills the finer from them. `readShare(k)`
/// waits for the unmatched share of level k, after level 0; `matchHalf(k)` halves level k -
/// 1 and matches it; `ascend(k)` fills level k from its half. Returns the number of levels.
template <class ReadShare, class MatchHalf, class Ascend>
int runCoarserLevels(const StereoLayout& layout, const ReadShare& readShare,
                     const MatchHalf& matchHalf, const Ascend& ascend) {
  double finer_unmatched = 2;  // more than any share
  int level = 0;
  while (level + 1 < static_cast<int>(layout.levels.size())) {
    const double unmatched = unmatchedShare(readShare(level));
    if (!isHalvingWorth(layout.levels[static_cast<std::size_t>(level)].options.elas, unmatched,
                        finer_unmatched))
      break;
    finer_unmatched = unmatched;
    matchHalf(++level);
  }
  for (int k = level; k-- > 0;) ascend(k);
  return level + 1;
}

}  // namespace softscope::cuda
