// tests/eval/statistics_test.cpp: numbers worked out by hand or by numpy.
#include "eval/statistics/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kSumRounding = 1e-12;  // sums of a few doubles near 10

TEST(Statistics, AreThoseOfTheDefinition) {
  const Statistics s = statistics({4, -1, 7, 2, 3});
  EXPECT_EQ(s.count, 5u);
  EXPECT_EQ(s.nan_count, 0u);
  EXPECT_NEAR(s.mean, 3, kSumRounding);
  EXPECT_NEAR(s.sd, std::sqrt(34.0 / 5), kSumRounding);    // 1 + 16 + 16 + 1 + 0
  EXPECT_NEAR(s.rmse, std::sqrt(79.0 / 5), kSumRounding);  // 16 + 1 + 49 + 4 + 9
  EXPECT_EQ(s.min, -1);
  EXPECT_EQ(s.median, 3);
  EXPECT_NEAR(s.p95, 4 + 0.8 * 3, kSumRounding);  // rank 3.8 of -1 2 3 4 7
  EXPECT_EQ(s.max, 7);
}

TEST(Statistics, LeaveNaNsOutAndCountThem) {
  const Statistics s = statistics({kNotANumber, 1, kNotANumber, 3});
  EXPECT_EQ(s.count, 2u);
  EXPECT_EQ(s.nan_count, 2u);
  EXPECT_EQ(s.mean, 2);
  EXPECT_EQ(s.median, 2);
  EXPECT_EQ(s.max, 3);
}

TEST(Statistics, OfNothingAreNaNNotZero) {
  for (const std::vector<double>& values : {std::vector<double>{}, {kNotANumber, kNotANumber}}) {
    const Statistics s = statistics(values);
    EXPECT_EQ(s.count, 0u);
    EXPECT_EQ(s.nan_count, values.size());
    for (const double x : {s.mean, s.sd, s.rmse, s.min, s.median, s.p95, s.max})
      EXPECT_TRUE(std::isnan(x));
  }
}

TEST(Statistics, OfOneValueAreThatValue) {
  const Statistics s = statistics({-2.5});
  EXPECT_EQ(s.mean, -2.5);
  EXPECT_EQ(s.sd, 0);
  EXPECT_EQ(s.rmse, 2.5);
  EXPECT_EQ(s.median, -2.5);
  EXPECT_EQ(s.p95, -2.5);
}

TEST(Statistics, KeepTheSpreadOfValuesFarFromZero) {
  // Mean of squares less square of mean would lose it: 1e18 carries no more than 128.
  EXPECT_NEAR(statistics({1e9 - 1, 1e9 + 1}).sd, 1, kSumRounding);
}

TEST(Percentiles, AgreeWithNumpy) {
  // numpy.percentile([15, 20, 35, 40, 50, 1.5], [0, 5, 25, 40, 50, 90, 99.5, 100])
  const std::vector<double> expected = {1.5, 4.875, 16.25, 20, 27.5, 45, 49.75, 50};
  const std::vector<double> found =
      percentiles({15, 20, 35, kNotANumber, 40, 50, 1.5}, {0, 5, 25, 40, 50, 90, 99.5, 100});
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], kSumRounding) << i;
}

TEST(Percentiles, RefuseWhatIsNoPercentage) {
  EXPECT_THROW(percentiles({1, 2}, {101}), OptionError);
  EXPECT_THROW(percentiles({1, 2}, {-1}), OptionError);
  EXPECT_THROW(percentiles({1, 2}, {kNotANumber}), OptionError);
  EXPECT_TRUE(std::isnan(percentiles({}, {50}).front()));
}

TEST(PercentAbove, IsStrictAndLeavesNaNsOut) {
  EXPECT_EQ(percentAbove({1, 2, 3, kNotANumber, 4}, 2), 50);
  EXPECT_TRUE(std::isnan(percentAbove({kNotANumber}, 2)));
}

}  // namespace
}  // namespace softscope
