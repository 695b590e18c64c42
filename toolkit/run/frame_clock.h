// toolkit/run/frame_clock.h: whether the times of frames are times.
#pragma once

#include <vector>

#include "core/trajectory.h"

namespace softscope {

/// A clip without timestamps counts frames as seconds: then a time says nothing. False as well
/// where times are missing or don't rise. Throws Error where the lengths differ.
bool hasClock(const std::vector<int>& frames, const std::vector<double>& times_s);
bool hasClock(const std::vector<int>& frames, const Trajectory& trajectory);

}  // namespace softscope
