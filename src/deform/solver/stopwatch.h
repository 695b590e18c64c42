// src/deform/solver/stopwatch.h: time of one part of a solve.
#pragma once

#include <chrono>

namespace softscope {

/// Adds the time until its destruction to one entry.
class Stopwatch {
 public:
  explicit Stopwatch(double* total_ms) : total_ms_(total_ms), start_(Clock::now()) {}
  ~Stopwatch() {
    *total_ms_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double* total_ms_;
  Clock::time_point start_;
};

}  // namespace softscope
