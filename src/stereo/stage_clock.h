// src/stereo/stage_clock.h: how long each stage took.
#pragma once

#include <chrono>
#include <string>

#include "stereo/stereo_matcher.h"

namespace softscope {

class StageClock {
 public:
  /// Ends the stage that began with the last lap.
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    laps_.emplace_back(stage, std::chrono::duration<double, std::milli>(now - begin_).count());
    begin_ = now;
  }
  const StageTimes& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  StageTimes laps_;
};

}  // namespace softscope
