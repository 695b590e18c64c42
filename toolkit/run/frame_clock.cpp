// toolkit/run/frame_clock.cpp: comparison of times with frame numbers.
#include "toolkit/run/frame_clock.h"

#include <cmath>

#include "core/error.h"

namespace softscope {

bool hasClock(const std::vector<int>& frames, const std::vector<double>& times_s) {
  if (frames.size() != times_s.size()) throw Error("clock: one time per frame is needed");
  bool counts_frames = true;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!std::isfinite(times_s[i]) || (i > 0 && times_s[i] <= times_s[i - 1])) return false;
    counts_frames = counts_frames && times_s[i] == frames[i];
  }
  return !counts_frames;
}

bool hasClock(const std::vector<int>& frames, const Trajectory& trajectory) {
  std::vector<double> times_s;
  for (const auto& pose : trajectory) times_s.push_back(pose.time_s);
  return hasClock(frames, times_s);
}

}  // namespace softscope
