// tests/stereo/patch_smoothing_test.cpp: noise goes, edges and relief stay.
#include "stereo/refinement/patch_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kWidth = 160, kHeight = 120;
using Surface = std::function<double(int u, int v)>;

/// A surface with noise that is alike within a refinement window, as the refinement's is, and its
/// true standard error.
DisparityMap noisy(const Surface& truth, double sigma_px) {
  constexpr int kReach = 10;
  const double window_px = RefinementOptions().windowSigmaPx();
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  Raster<double> white(kWidth + 2 * kReach, kHeight + 2 * kReach);
  for (double& value : white.values) value = normal(random);
  std::vector<double> kernel;
  double power = 0;
  for (int k = -kReach; k <= kReach; ++k) {
    kernel.push_back(std::exp(-0.5 * k * k / (window_px * window_px)));
    power += kernel.back() * kernel.back();
  }
  DisparityMap map{Raster<float>(kWidth, kHeight), Raster<float>(kWidth, kHeight, 0)};
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      double sum = 0;
      for (int y = 0; y <= 2 * kReach; ++y)
        for (int x = 0; x <= 2 * kReach; ++x)
          sum += kernel[static_cast<std::size_t>(y)] * kernel[static_cast<std::size_t>(x)] *
                 white.at(u + x, v + y);
      map.disparity_px.at(u, v) = static_cast<float>(truth(u, v) + sigma_px * sum / power);
      map.sigma_px.at(u, v) = static_cast<float>(sigma_px);
    }
  return map;
}

double rmsError(const DisparityMap& map, const Surface& truth, int border_px = 12) {
  double sum = 0;
  int count = 0;
  for (int v = border_px; v < kHeight - border_px; ++v)
    for (int u = border_px; u < kWidth - border_px; ++u, ++count)
      sum += std::pow(map.disparity_px.at(u, v) - truth(u, v), 2);
  return std::sqrt(sum / count);
}

DisparityMap smoothed(DisparityMap map, const SmoothingOptions& options = {}) {
  smoothByPatches(options, RefinementOptions(), map);
  return map;
}

const Surface kSlope = [](int u, int v) { return 40 + 0.08 * u - 0.05 * v; };

/// As in a picture 800 pixels wide.
SmoothingOptions wide() {
  SmoothingOptions options;
  options.block_px = 10;
  return options;
}

TEST(PatchSmoothing, TakesMuchOfTheNoiseFromASlope) {
  const DisparityMap before = noisy(kSlope, 0.4);
  EXPECT_NEAR(rmsError(before, kSlope), 0.4, 0.06);  // the noise is what it claims to be
  // Nine independent measurements lie in a window, for the six unknowns of a patch, one of which is
  // the pixel itself.
  EXPECT_LT(rmsError(smoothed(before, wide()), kSlope, 25), 0.8 * rmsError(before, kSlope));
}

TEST(PatchSmoothing, DoesNotMoveABulge) {
  // A curved patch follows a quadric exactly: the residual is the noise.
  const Surface bulge = [](int u, int v) {
    return 60 - 0.004 * (u - 80) * (u - 80) - 0.003 * (v - 60) * (v - 60);
  };
  const DisparityMap after = smoothed(noisy(bulge, 0.3), wide());
  double sum = 0;
  for (int v = 50; v < 70; ++v)
    for (int u = 70; u < 90; ++u) sum += after.disparity_px.at(u, v) - bulge(u, v);
  EXPECT_NEAR(sum / 400, 0, 0.12);  // noise of about four independent measurements
}

TEST(PatchSmoothing, PredictsTheErrorThatIsLeft) {
  const DisparityMap after = smoothed(noisy(kSlope, 0.4), wide());
  double variance = 0;
  for (const float sigma : after.sigma_px.values) variance += sigma * sigma;
  const double predicted = std::sqrt(variance / static_cast<double>(after.sigma_px.size()));
  EXPECT_GT(predicted, 0.6 * rmsError(after, kSlope));
  EXPECT_LT(predicted, 1.6 * rmsError(after, kSlope));
}

TEST(PatchSmoothing, KeepsBothSidesOfADepthStep) {
  const Surface step = [](int u, int) { return u < kWidth / 2 ? 60.0 : 45.0; };
  const DisparityMap after = smoothed(noisy(step, 0.1));
  for (int v = 20; v < kHeight - 20; ++v)
    for (int u = kWidth / 2 - 8; u < kWidth / 2 + 8; ++u)
      ASSERT_NEAR(after.disparity_px.at(u, v), step(u, v), 0.5) << u << ", " << v;  // 5 sigma
}

TEST(PatchSmoothing, KeepsReliefThatWasReallyMeasured) {
  // Folds 30 px from crest to crest, far higher than the noise.
  const Surface folds = [](int u, int v) {
    return 50 + 1.5 * std::sin(2 * M_PI * u / 30) + 0.02 * v;
  };
  const DisparityMap before = noisy(folds, 0.06);
  EXPECT_LT(rmsError(smoothed(before), folds), 1.1 * rmsError(before, folds));
}

TEST(PatchSmoothing, LeavesHolesAndTheUnknownAlone) {
  DisparityMap map = noisy(kSlope, 0.2);
  map.disparity_px.at(50, 50) = map.sigma_px.at(50, 50) = std::numeric_limits<float>::quiet_NaN();
  map.sigma_px.at(60, 50) = 0;  // a matcher without predicted errors
  const float untouched = map.disparity_px.at(60, 50);
  const DisparityMap after = smoothed(map);
  EXPECT_TRUE(std::isnan(after.disparity_px.at(50, 50)));
  EXPECT_TRUE(std::isnan(after.sigma_px.at(50, 50)));
  EXPECT_EQ(after.disparity_px.at(60, 50), untouched);
}

TEST(PatchSmoothing, SurvivesALonePixelAndNothingAtAll) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  DisparityMap map{Raster<float>(33, 17, nan), Raster<float>(33, 17, nan)};
  smoothByPatches({}, RefinementOptions(), map);
  for (const float d : map.disparity_px.values) EXPECT_TRUE(std::isnan(d));
  map.disparity_px.at(7, 9) = 12;
  map.sigma_px.at(7, 9) = 0.3f;
  smoothByPatches({}, RefinementOptions(), map);
  EXPECT_EQ(map.disparity_px.at(7, 9), 12);
}

TEST(PatchSmoothing, IsSwitchedOffByNoReach) {
  const DisparityMap before = noisy(kSlope, 0.3);
  SmoothingOptions off;
  off.reach_blocks = 0;
  EXPECT_EQ(smoothed(before, off).disparity_px.values, before.disparity_px.values);
}

TEST(PatchSmoothing, GivesTheSameBytesOnAnyNumberOfThreads) {
  const DisparityMap before = noisy(kSlope, 0.3);
  const DisparityMap many = smoothed(before);
  const ThreadLimit one(1);
  EXPECT_EQ(smoothed(before).disparity_px.values, many.disparity_px.values);
}

}  // namespace
}  // namespace softscope
