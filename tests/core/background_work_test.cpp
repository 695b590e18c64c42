// tests/core/background_work_test.cpp: background work is done, whatever else is.
#include "core/background_work.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "core/error.h"
#include "core/parallel.h"

namespace softscope {
namespace {

std::vector<int> squaresOf(int count) {
  std::vector<int> squares(static_cast<std::size_t>(count));
  parallelRanges(count, 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) squares[static_cast<std::size_t>(i)] = i * i;
  });
  return squares;
}

TEST(BackgroundWork, GivesTheSameResultsBesideOtherLoops) {
  constexpr int kCount = 2000;
  std::vector<int> in_background;
  std::future<void> work = std::async(
      std::launch::async, [&] { runInBackground([&] { in_background = squaresOf(kCount); }); });
  const std::vector<int> here = squaresOf(kCount);
  work.get();
  EXPECT_EQ(in_background, here);
  EXPECT_EQ(here.back(), (kCount - 1) * (kCount - 1));
}

TEST(BackgroundWork, PassesOnWhatIsThrown) {
  EXPECT_THROW(runInBackground([] { throw InputError("no right view"); }), InputError);
  EXPECT_THROW(runInBackground([] {
                 parallelRanges(100, 1, [](int begin, int) {
                   if (begin == 50) throw InputError("in a loop");
                 });
               }),
               InputError);
}

}  // namespace
}  // namespace softscope
