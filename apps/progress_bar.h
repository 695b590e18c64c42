// apps/progress_bar.h: progress, speed and remaining time.
#pragma once

#include <chrono>
#include <functional>
#include <iosfwd>
#include <string>

namespace softscope {

/// On a terminal one line, updated at most ten times per second; elsewhere
/// a line every ten seconds and one at the end, so that logs stay readable.
class ProgressBar {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style { kSilent, kPlain, kTerminal };

  /// `total` 0: unknown, without ETA. `now` returns the time (replaced in tests).
  ProgressBar(std::string what, int total, Style style, std::ostream& out,
              std::function<Clock::time_point()> now = Clock::now);
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void advance();

 private:
  double secondsSince(Clock::time_point start) const;
  std::string line() const;
  std::string bar() const;
  void show();

  std::string what_;
  int total_;
  int done_ = 0;
  int shown_ = -1;
  Style style_;
  std::ostream& out_;
  std::function<Clock::time_point()> now_;
  Clock::time_point start_;
  Clock::time_point last_shown_;
};

/// Style for stderr: silent with --quiet.
ProgressBar::Style progressStyle(bool quiet);

}  // namespace softscope
