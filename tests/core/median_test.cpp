#include "core/median.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope {
namespace {

TEST(Median, IsTheUpperOfTwoMiddleValues) {
  EXPECT_EQ(medianOf<double>({3, 1, 2}), 2);
  EXPECT_EQ(medianOf<double>({4, 1, 3, 2}), 3);
  EXPECT_TRUE(std::isnan(medianOf<float>({})));
}

TEST(Quantile, IsTheValueAtTheRankBelow) {
  const std::vector<float> values{5, 1, 4, 2, 3};
  EXPECT_EQ(quantileOf(values, 0), 1);
  EXPECT_EQ(quantileOf(values, 0.49), 2);
  EXPECT_EQ(quantileOf(values, 0.5), 3);
  EXPECT_EQ(quantileOf(values, 1), 5);
  EXPECT_TRUE(std::isnan(quantileOf<float>({}, 0.5)));
}

}  // namespace
}  // namespace softscope
