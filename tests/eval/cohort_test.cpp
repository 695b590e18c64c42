#include "eval/statistics/cohort.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kNone = Statistics::kNone;

TEST(Cohort, StudentQuantilesAreThoseOfTables) {
  // scipy.stats.t.ppf; with one degree of freedom it is tan(pi (p - 1/2)).
  EXPECT_NEAR(studentQuantile(0.975, 1), std::tan(M_PI * 0.475), 1e-9);
  EXPECT_NEAR(studentQuantile(0.975, 4), 2.7764451051977987, 1e-10);
  EXPECT_NEAR(studentQuantile(0.975, 9), 2.2621571627409915, 1e-10);
  EXPECT_NEAR(studentQuantile(0.025, 30), -2.042272456301238, 1e-10);
  EXPECT_NEAR(studentQuantile(0.975, 1e7), 1.959963984540054, 1e-6);
  EXPECT_NEAR(studentQuantile(0.5, 3), 0, 1e-9);
  EXPECT_THROW(studentQuantile(1, 3), OptionError);
  EXPECT_THROW(studentQuantile(0.9, 0), OptionError);
}

TEST(Cohort, TheIntervalOfAMeanIsStudents) {
  const Interval interval = meanInterval(statistics({1, 2, 3}));  // s = 1, t of 2 degrees: 4.3027
  EXPECT_NEAR(interval.low, 2 - 4.3027 / std::sqrt(3.0), 1e-4);
  EXPECT_NEAR(interval.high, 2 + 4.3027 / std::sqrt(3.0), 1e-4);
  EXPECT_TRUE(std::isnan(meanInterval(statistics({1})).low));
}

TEST(Cohort, SummaryOfAHandMadeSet) {
  const CohortSummary s = summariseCohort({1, 2, kNone, 3, 4, 10}, 1);
  EXPECT_EQ(s.count, 5u);
  EXPECT_DOUBLE_EQ(s.mean, 4);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(50.0 / 4));  // deviations -3 -2 -1 0 6, over n - 1
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.quartile_1, 2);
  EXPECT_DOUBLE_EQ(s.quartile_3, 4);
  EXPECT_TRUE(std::isnan(summariseCohort({7}, 1).sd)) << "one case has no spread";
  EXPECT_EQ(summariseCohort({kNone}, 1).count, 0u);
}

TEST(Cohort, BootstrapIsSeededAndFindsTheNormalIntervalOfALargeSet) {
  std::vector<double> values;
  for (int i = 0; i < 400; ++i) values.push_back(i % 20);  // mean 9.5, variance 33.25
  const Interval a = bootstrapMean(values, 7), same = bootstrapMean(values, 7);
  EXPECT_EQ(a.low, same.low);
  EXPECT_EQ(a.high, same.high);
  EXPECT_NE(a.low, bootstrapMean(values, 8).low);
  const double half = 1.96 * std::sqrt(33.25 / 400);
  EXPECT_NEAR(a.low, 9.5 - half, 0.06);  // 2000 resamples: an end is good to a tenth of `half`
  EXPECT_NEAR(a.high, 9.5 + half, 0.06);
  EXPECT_TRUE(std::isnan(bootstrapMean({1, 2}, 1).low)) << "two values tell nothing of a spread";
}

TEST(Cohort, BlandAltmanFollowsItsClosedFormulas) {
  const BlandAltman b = blandAltman({1, 2, kNone, 3, 4, 5});
  const double sd = std::sqrt(2.5), t = 2.7764451051977987;
  EXPECT_EQ(b.count, 5u);
  EXPECT_DOUBLE_EQ(b.bias, 3);
  EXPECT_NEAR(b.sd, sd, 1e-14);
  EXPECT_NEAR(b.limits.low, 3 - 1.959963984540054 * sd, 1e-12);
  EXPECT_NEAR(b.limits.high, 3 + 1.959963984540054 * sd, 1e-12);
  EXPECT_NEAR(b.bias_ci.high - b.bias, t * sd / std::sqrt(5.0), 1e-9);
  const double of_limit = t * sd * std::sqrt(0.2 + 1.959963984540054 * 1.959963984540054 / 8);
  EXPECT_NEAR(b.high_limit_ci.high - b.limits.high, of_limit, 1e-9);
  EXPECT_NEAR(b.limits.low - b.low_limit_ci.low, of_limit, 1e-9);
  EXPECT_TRUE(std::isnan(blandAltman({3}).limits.low));
  EXPECT_EQ(blandAltman({3}).bias, 3);
}

TEST(Cohort, SignedRankTestIsExactForFewAndKnowsTies) {
  // All of five positive: 1 of 32 signs on either side.
  EXPECT_NEAR(signedRankTest({1, 2, 3, 4, 5}).p_value, 2.0 / 32, 1e-12);
  EXPECT_EQ(signedRankTest({1, 2, 3, 4, 5}).rank_sum, 15);
  // Ranks 1.5 1.5 3: of 8 signs, sums 0, 1.5, 1.5, 3, 3, 4.5, 4.5, 6; 6 and 0 are farthest.
  EXPECT_NEAR(signedRankTest({1, 1, 2, 0}).p_value, 2.0 / 8, 1e-12);
  EXPECT_EQ(signedRankTest({1, 1, 2, 0}).count, 3u) << "zeros are left out";
  EXPECT_NEAR(signedRankTest({1.5, -0.3, 2.1, 0.7, -1.2, 3.3, 0.9, 0.4}).p_value, 0.109375, 1e-9)
      << "scipy.stats.wilcoxon, exact";
  EXPECT_TRUE(std::isnan(signedRankTest({0, 0}).p_value));
}

TEST(Cohort, SignedRankTestOfManyIsTheNormalApproximation) {
  std::vector<double> differences;  // 1 -2 3 -4 … -40: ranks are the magnitudes
  for (int i = 1; i <= 40; ++i) differences.push_back(i % 2 == 1 ? i : -i);
  const SignedRankTest test = signedRankTest(differences);
  EXPECT_EQ(test.rank_sum, 400);  // 1 + 3 + … + 39
  const double z = (410 - 400 - 0.5) / std::sqrt(40.0 * 41 * 81 / 24);
  EXPECT_NEAR(test.p_value, std::erfc(z / std::sqrt(2.0)), 1e-12);
}

}  // namespace
}  // namespace softscope
