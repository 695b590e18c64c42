// src/stereo/matching/stage_clock.h: time of each stage.
#pragma once

#include <chrono>
#include <string>

#include "stereo/matching/stereo_matcher.h"

namespace softscope {

class StageClock {
 public:
  /// Ends the stage that started with the last lap; laps with the same name add up.
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double elapsed_ms = std::chrono::duration<double, std::milli>(now - begin_).count();
    begin_ = now;
    for (auto& [name, total_ms] : laps_)
      if (name == stage) {
        total_ms += elapsed_ms;
        return;
      }
    laps_.emplace_back(stage, elapsed_ms);
  }
  const StageTimes& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  StageTimes laps_;
};

}  // namespace softscope
