// tests/stereo/matcher_test.cpp: every matcher measures made scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/parallel.h"
#include "stereo/matching/stereo_matcher.h"
#include "support/scene.h"

namespace softscope {
namespace {

struct Score {
  double median_px = 0, bad3_percent = 0, coverage = 0;
};

/// Over pixels with a match inside the right picture.
Score scoreOf(const DisparityMap& found, const Raster<float>& truth) {
  std::vector<double> errors;
  std::size_t matchable = 0, bad = 0;
  for (int v = 0; v < truth.height_px; ++v)
    for (int u = 0; u < truth.width_px; ++u) {
      if (!(static_cast<float>(u) - truth.at(u, v) >= 0)) continue;
      ++matchable;
      const double e = std::abs(found.disparity_px.at(u, v) - truth.at(u, v));
      if (std::isnan(e)) continue;
      errors.push_back(e);
      bad += e > 3;
    }
  if (errors.empty()) return {};
  std::nth_element(errors.begin(), errors.begin() + errors.size() / 2, errors.end());
  return {errors[errors.size() / 2], 100.0 * bad / errors.size(),
          static_cast<double>(errors.size()) / matchable};
}

class EveryStereoMatcher : public testing::TestWithParam<const char*> {
 protected:
  static std::unique_ptr<StereoMatcher> matcher() {
    StereoOptions options;
    options.method = GetParam();
    options.disparity_max_px = 127;
    return makeStereoMatcher(options);
  }
  // The parabola of SGBM is biased to whole pixels; that of softscope follows the brightness.
  static double medianTolerancePx() { return GetParam() == std::string("elas") ? 0.05 : 0.15; }
};

TEST_P(EveryStereoMatcher, MeasuresAPlane) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.3, 0.1), 2.0);
  const auto stereo = matcher();
  ASSERT_EQ(stereo->name(), GetParam());  // two matchers compared, not one with itself
  const Score score = scoreOf(stereo->match(scene.left, scene.right), scene.disparity_px);
  EXPECT_LT(score.median_px, medianTolerancePx());  // 0.05 px is 0.1 mm at 55 mm here
  EXPECT_LT(score.bad3_percent, 0.1);
  EXPECT_GT(score.coverage, 0.95);
}

TEST_P(EveryStereoMatcher, MeasuresTwoSurfaces) {
  const auto scene = test::makeScene(
      test::endoscope(), test::nearest(test::sphere({3, 0, 55}, 12), test::plane(75, 0.2)), 2.0);
  const Score score = scoreOf(matcher()->match(scene.left, scene.right), scene.disparity_px);
  EXPECT_LT(score.median_px, medianTolerancePx());
  EXPECT_LT(score.bad3_percent, 1.0);
}

TEST_P(EveryStereoMatcher, GivesTheSameBytesOnAnyNumberOfThreads) {
  const auto scene = test::makeScene(
      test::endoscope(), test::nearest(test::sphere({3, 0, 55}, 12), test::plane(75, 0.2)), 3.0);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return matcher()->match(scene.left, scene.right);
  };
  const DisparityMap one = run(1), two = run(2), again = run(2);
  const auto same = [](const Raster<float>& a, const Raster<float>& b) {
    return std::memcmp(a.values.data(), b.values.data(), a.size() * sizeof(float)) == 0;
  };
  EXPECT_TRUE(same(one.disparity_px, two.disparity_px));
  EXPECT_TRUE(same(one.sigma_px, two.sigma_px));
  EXPECT_TRUE(same(two.disparity_px, again.disparity_px));
}

TEST_P(EveryStereoMatcher, TellsWhereItMeasuredAndHowWell) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55), 2.0);
  const auto stereo = matcher();
  const DisparityMap map = stereo->match(scene.left, scene.right);
  ASSERT_TRUE(map.disparity_px.sameShape(scene.left));
  for (std::size_t i = 0; i < map.disparity_px.size(); ++i) {
    EXPECT_EQ(std::isnan(map.disparity_px.values[i]), std::isnan(map.sigma_px.values[i]));
    EXPECT_FALSE(map.sigma_px.values[i] <= 0);  // NaN or positive
  }
  EXPECT_FALSE(stereo->times().empty());
}

TEST_P(EveryStereoMatcher, LosesNoColumnToTheRangeOfDisparities) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(90), 1.0);  // 15.6 px
  StereoOptions options;
  options.method = GetParam();
  options.disparity_max_px = 255;
  const DisparityMap map = makeStereoMatcher(options)->match(scene.left, scene.right);
  int measured = 0;
  for (int u = 20; u < 60; ++u) measured += !std::isnan(map.disparity_px.at(u, 120));
  EXPECT_GT(measured, 35);
}

INSTANTIATE_TEST_SUITE_P(Stereo, EveryStereoMatcher, testing::Values("elas", "sgbm"),
                         [](const auto& param) { return std::string(param.param); });

TEST(ElasMatcher, FindsTheLargerDisparitiesOfLargerImages) {
  RectifiedRig rig = test::endoscope(960, 120);
  rig.baseline_mm = 20;
  const auto scene = test::makeScene(rig, test::plane(55), 1.0);  // 305 px
  const Score score =
      scoreOf(makeStereoMatcher({})->match(scene.left, scene.right), scene.disparity_px);
  EXPECT_LT(score.median_px, 0.1);
  EXPECT_GT(score.coverage, 0.9);
}

TEST(ElasMatcher, MatchesUnderAnExposureDifference) {
  auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.3, 0.1), 1.0);
  for (auto& gray : scene.right.values) gray = static_cast<std::uint8_t>(0.85 * gray + 12);
  const Score score =
      scoreOf(makeStereoMatcher({})->match(scene.left, scene.right), scene.disparity_px);
  EXPECT_LT(score.median_px, 0.1);
  EXPECT_GT(score.coverage, 0.9);
}

}  // namespace
}  // namespace softscope
