// tests/vtk_views/test_nice_ticks.cpp: axes carry round numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "vtk_views/drawing/nice_ticks.h"

namespace softscope {
namespace {

TEST(NiceTicks, AreRoundAndInside) {
  const Ticks ticks = niceTicks(41.2, 78.9, 6);
  ASSERT_EQ(ticks.values.size(), 7u);
  EXPECT_DOUBLE_EQ(ticks.values.front(), 45);
  EXPECT_DOUBLE_EQ(ticks.values.back(), 75);
  EXPECT_EQ(ticks.label(ticks.values[1]), "50");
}

TEST(NiceTicks, KeepBoundsThatAreRound) {
  const Ticks ticks = niceTicks(0.1, 0.5, 4);
  EXPECT_EQ(ticks.label(ticks.values.front()), "0.1");
  EXPECT_EQ(ticks.label(ticks.values.back()), "0.5");
}

TEST(RoundUp, EndsAtOneTwoOrFive) {
  EXPECT_DOUBLE_EQ(roundUp(0.13), 0.2);
  EXPECT_DOUBLE_EQ(roundUp(2.1), 2.5);
  EXPECT_DOUBLE_EQ(roundUp(2.6), 5);
  EXPECT_DOUBLE_EQ(roundUp(6), 10);
  EXPECT_DOUBLE_EQ(roundUp(0.5), 0.5) << "a round number stays";
  for (const double none : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(roundUp(none), 1);
}

TEST(NiceTicks, RefuseEmptyRanges) {
  EXPECT_THROW(niceTicks(3, 3, 5), Error);
  EXPECT_THROW(niceTicks(0, std::numeric_limits<double>::infinity(), 5), Error);
}

}  // namespace
}  // namespace softscope
