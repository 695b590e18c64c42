// tests/eval/series_test.cpp: drift, jitter, Hausdorff distances, histograms, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "eval/statistics/error_series.h"
#include "eval/statistics/histogram.h"
#include "eval/surfaces/hausdorff.h"

namespace softscope {
namespace {

constexpr double kRounding = 1e-12;

std::vector<double> upTo(int count) {
  std::vector<double> x(static_cast<std::size_t>(count));
  std::iota(x.begin(), x.end(), 0.0);
  return x;
}

TEST(TheilSen, AQuarterOfWildSamplesDoesNotMoveTheSlope) {
  const auto x = upTo(40);
  std::vector<double> y;
  for (const double t : x) y.push_back(0.1 + 0.02 * t);
  for (std::size_t i = 0; i < y.size(); i += 4) y[i] = 1000 - 7 * x[i];
  // Among 780 slopes, 435 (of clean pairs) are 0.02, so the median is.
  EXPECT_NEAR(theilSenSlope(x, y), 0.02, kRounding);
}

TEST(TheilSen, IsTheMedianSlopeOfAllPairs) {
  // Slopes 1 (0,1), 2 (0,2), 3 (1,2): by hand.
  EXPECT_NEAR(theilSenSlope({0, 1, 2}, {0, 1, 4}), 2, kRounding);
}

TEST(TheilSen, LeavesOutWhatIsNoNumberAndSaysSoWhereNothingIsLeft) {
  const double nan = std::nan("");
  EXPECT_NEAR(theilSenSlope({0, 1, 2, 3}, {0, nan, 4, 6}), 2, kRounding);
  EXPECT_TRUE(std::isnan(theilSenSlope({}, {})));
  EXPECT_TRUE(std::isnan(theilSenSlope({1, 1}, {0, 5}))) << "one moment has no slope";
  EXPECT_THROW(theilSenSlope({1}, {}), InputError);
}

TEST(TheilSen, AVeryLongSeriesIsThinnedNotRefused) {
  const auto x = upTo(30001);
  std::vector<double> y;
  for (const double t : x) y.push_back(3 - 0.5 * t);
  EXPECT_NEAR(theilSenSlope(x, y), -0.5, kRounding);
}

TEST(SecondDifferences, AreZeroOnALineAndTwiceAJump) {
  const auto flat = secondDifferences(upTo(5), {1, 2, 3, 4, 5});
  EXPECT_TRUE(std::isnan(flat[0]) && std::isnan(flat[4]));
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(flat[static_cast<std::size_t>(i)], 0, kRounding);
  EXPECT_NEAR(secondDifferences(upTo(3), {0, 1, 0})[1], -2, kRounding);
}

TEST(SecondDifferences, NeedEvenSpacing) {
  const auto d = secondDifferences({0, 1, 3, 5}, {0, 1, 3, 6});
  EXPECT_TRUE(std::isnan(d[1])) << "steps of 1 and 2";
  EXPECT_NEAR(d[2], 1, kRounding);
}

TEST(Hausdorff, ThreeDefinitionsOfOneName) {
  // Forth: 0 … 100, P95 95. Back: ten times 10, P95 10. Pooled, 111 values: rank 104.5, between
  // the sorted values 94 and 95 (the ten 10s lie below).
  const auto forth = upTo(101);
  const std::vector<double> back(10, 10.0);
  const HausdorffDistances d = hausdorffDistances(forth, back);
  EXPECT_NEAR(d.hd95_max_of_directed_mm, 95, kRounding);
  EXPECT_NEAR(d.hd95_mean_of_directed_mm, 52.5, kRounding);
  EXPECT_NEAR(d.hd95_pooled_mm, 94.5, kRounding);
  EXPECT_NEAR(d.hd_mm, 100, kRounding);
  EXPECT_NEAR(d.assd_mm, (5050.0 + 100) / 111, kRounding);
  EXPECT_NEAR(d.masd_mm, 30, kRounding);
  EXPECT_TRUE(std::isnan(hausdorffDistances(forth, {}).hd95_pooled_mm));
}

TEST(HistogramCounts, KnowsItsEdgesAndWhatLiesBeyond) {
  const Histogram h = histogram({-1, 0, 0.49, 0.5, 0.99, 1, 7, std::nan("")}, 0, 1, 2);
  EXPECT_EQ(h.counts, (std::vector<std::size_t>{2, 2}));
  EXPECT_EQ(h.below, 1u);
  EXPECT_EQ(h.above, 2u);
  EXPECT_EQ(h.total, 7u);
  EXPECT_NEAR(h.cumulativeShares()[1], 5.0 / 7, kRounding);
  EXPECT_THROW(histogram({}, 1, 1, 3), OptionError);
  EXPECT_THROW(histogram({}, 0, 1, 0), OptionError);
}

}  // namespace
}  // namespace softscope
