// tests/eval/predicted_sigma_test.cpp: errors whose standard deviation is known.
#include "eval/images/predicted_sigma.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"

namespace softscope {
namespace {

struct Sample {
  std::vector<double> errors, sigmas;
};

/// Normal errors with the sigmas that they are drawn with, times `told`.
Sample drawn(double told) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Sample sample;
  for (int i = 0; i < 20000; ++i) {
    const double sigma = 0.1 + 0.0001 * i;
    sample.errors.push_back(sigma * normal(random));
    sample.sigmas.push_back(told * sigma);
  }
  return sample;
}

TEST(PredictedSigma, ATrueOneCoversWhatItsIntervalsSay) {
  const Sample right = drawn(1);
  const IntervalCoverage coverage = intervalCoverage(right.errors, right.sigmas);
  EXPECT_EQ(coverage.count, 20000u);
  EXPECT_NEAR(coverage.within_50, 0.50, 0.015);  // four standard errors of a share of 20 000
  EXPECT_NEAR(coverage.within_68, 0.68, 0.015);
  EXPECT_NEAR(coverage.within_95, 0.95, 0.007);
  const Sample sure = drawn(0.5);
  EXPECT_LT(intervalCoverage(sure.errors, sure.sigmas).within_95, 0.75) << "too sure";
}

TEST(PredictedSigma, RemovingTheLeastSureLeavesSmallerErrors) {
  const Sample right = drawn(1);
  const Sparsification by_sigma = sparsification(right.errors, right.sigmas);
  ASSERT_EQ(by_sigma.mean_left.size(), 10u);
  EXPECT_LT(by_sigma.mean_left[5], 0.7 * by_sigma.mean_left[0]);
  EXPECT_LT(by_sigma.best_left[5], by_sigma.mean_left[5]);
  std::vector<double> equal(right.errors.size(), 1.0), exact;
  for (const double error : right.errors) exact.push_back(std::abs(error));
  EXPECT_NEAR(sparsification(right.errors, exact).area, 0, 1e-9) << "the error itself";
  std::vector<double> wrong;
  for (const double error : exact) wrong.push_back(1 / (1e-6 + error));
  EXPECT_GT(sparsification(right.errors, wrong).area, 0.9) << "sure where it is wrong";
}

TEST(PredictedSigma, UnknownValuesAreLeftOut) {
  const IntervalCoverage coverage = intervalCoverage({0.1, NAN, 0.1, 0.1}, {1, 1, NAN, 0});
  EXPECT_EQ(coverage.count, 1u);
  EXPECT_EQ(coverage.within_50, 1);
  EXPECT_TRUE(std::isnan(intervalCoverage({}, {}).within_50));
  EXPECT_TRUE(sparsification({}, {}).mean_left.empty());
  EXPECT_THROW(intervalCoverage({1}, {}), InputError);
}

}  // namespace
}  // namespace softscope
