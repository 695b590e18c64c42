// tests/apps/test_progress_bar.cpp: count, rate, time left; calm where stderr is a log.
#include <gmock/gmock.h>

#include <sstream>

#include "apps/progress_bar.h"

namespace softscope {
namespace {

using testing::HasSubstr;
using Style = ProgressBar::Style;

/// A clock that moves when told.
struct HandClock {
  ProgressBar::Clock::time_point time{};
  void pass(double seconds) {
    time += std::chrono::duration_cast<ProgressBar::Clock::duration>(
        std::chrono::duration<double>(seconds));
  }
};

std::string linesOf(Style style, int total, int steps, double seconds_a_step) {
  HandClock clock;
  std::ostringstream out;
  {
    ProgressBar bar("depth", total, style, out, [&] { return clock.time; });
    for (int i = 0; i < steps; ++i) {
      clock.pass(seconds_a_step);
      bar.advance();
    }
  }
  return out.str();
}

TEST(ProgressBar, TellsCountRateAndTimeLeft) {
  // 20 of 80 in 10 s: 2 a second, 30 s left.
  EXPECT_THAT(linesOf(Style::kTerminal, 80, 20, 0.5), HasSubstr("] 20/80, 2.0/s, 0:30 left"));
  EXPECT_THAT(linesOf(Style::kTerminal, 2, 2, 40), HasSubstr("2/2, 0.0/s, took 1:20"));
}

TEST(ProgressBar, ALogGetsALineEveryTenSecondsAndOneAtTheEnd) {
  const std::string lines = linesOf(Style::kPlain, 100, 100, 0.25);  // 25 s in all
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 3);
  EXPECT_EQ(lines.find('\r'), std::string::npos);
  EXPECT_THAT(lines, HasSubstr("depth 40/100"));
  EXPECT_THAT(lines, HasSubstr("depth 100/100, 4.0/s, took 0:25"));
}

TEST(ProgressBar, ATerminalIsRewrittenTenTimesASecondAtMost) {
  const std::string lines = linesOf(Style::kTerminal, 1000, 1000, 0.001);
  EXPECT_LE(std::count(lines.begin(), lines.end(), '\r'), 12);  // one second, first and last
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 1);
}

TEST(ProgressBar, QuietIsSilent) { EXPECT_EQ(linesOf(Style::kSilent, 10, 10, 1), ""); }

TEST(ProgressBar, AnUnknownTotalHasNoEta) {
  const std::string lines = linesOf(Style::kPlain, 0, 50, 1);
  EXPECT_THAT(lines, HasSubstr("depth 50, 1.0/s"));
  EXPECT_THAT(lines, testing::Not(HasSubstr("left")));
}

}  // namespace
}  // namespace softscope
