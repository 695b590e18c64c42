// toolkit/run/frame_clock.h: validity of frame times.
#pragma once

#include <vector>

#include "core/trajectory.h"

namespace softscope {

/// False if the times are frame numbers (clip without timestamps),
/// missing or not ascending. Throws Error for different lengths.
bool hasClock(const std::vector<int>& frames, const std::vector<double>& times_s);
bool hasClock(const std::vector<int>& frames, const Trajectory& trajectory);

}  // namespace softscope
