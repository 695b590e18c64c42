// tests/stereo/subpixel_refinement_test.cpp: hundredths of a pixel, and honest about the error.
#include "stereo/subpixel_refinement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/scene.h"

namespace softscope {
namespace {

/// What a perfect whole-pixel matcher would hand over: NaN where the right picture ends.
Raster<float> rounded(const Raster<float>& truth) {
  Raster<float> whole = truth;
  for (int v = 0; v < truth.height_px; ++v)
    for (int u = 0; u < truth.width_px; ++u) {
      float& d = whole.at(u, v);
      d = static_cast<float>(u) < d ? std::numeric_limits<float>::quiet_NaN() : std::round(d);
    }
  return whole;
}

struct Errors {
  double median_px, bias_px, median_of_sigmas;
  std::size_t measured;
};

Errors errorsOf(const DisparityMap& map, const Raster<float>& truth) {
  std::vector<double> absolute, ratio;
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double e = map.disparity_px.values[i] - truth.values[i];
    if (std::isnan(e)) continue;
    sum += e;
    absolute.push_back(std::abs(e));
    ratio.push_back(std::abs(e) / map.sigma_px.values[i]);
  }
  const auto median = [](std::vector<double> v) {
    std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
    return v[v.size() / 2];
  };
  return {median(absolute), sum / absolute.size(), median(ratio), absolute.size()};
}

TEST(SubpixelRefinement, FindsAPlaneToATwentiethPixel) {
  for (const double distance_mm : {45.0, 51.3, 58.7}) {
    const auto scene = test::makeScene(test::endoscope(), test::plane(distance_mm), 0);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    EXPECT_LT(e.median_px, 0.05);  // whole pixels are up to half a pixel off, all to one side
    EXPECT_LT(std::abs(e.bias_px), 0.08);  // patches without texture stay where they began
  }
}

TEST(SubpixelRefinement, FollowsSlantAndCurvature) {
  for (const auto& surface : {test::plane(55, 0.6, 0.3), test::sphere({0, 0, 80}, 30)}) {
    const auto scene = test::makeScene(test::endoscope(), surface, 1.0);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    EXPECT_LT(e.median_px, 0.05);  // with sensor noise of one grey level
  }
}

TEST(SubpixelRefinement, PredictsItsError) {
  for (const double noise_gray : {1.0, 3.0, 6.0}) {
    const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), noise_gray);
    const auto e =
        errorsOf(refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {}),
                 scene.disparity_px);
    // For a Gaussian, half of all errors lie within 0.67 standard errors. A factor of two either
    // way is what the prediction promises.
    EXPECT_GT(e.median_of_sigmas, 0.33) << noise_gray;
    EXPECT_LT(e.median_of_sigmas, 1.35) << noise_gray;
  }
}

TEST(SubpixelRefinement, KeepsTwoSurfacesApart) {
  const auto scene = test::makeScene(
      test::endoscope(), test::nearest(test::sphere({0, 0, 52}, 12), test::plane(70)), 1.0);
  const auto map = refineDisparity(scene.left, scene.right, rounded(scene.disparity_px), {});
  int between = 0, measured = 0;
  for (std::size_t i = 0; i < map.disparity_px.size(); ++i) {
    const float e = std::abs(map.disparity_px.values[i] - scene.disparity_px.values[i]);
    if (std::isnan(e)) continue;
    ++measured;
    between += e > 1.0f;
  }
  EXPECT_GT(measured, 60000);
  // The step is 13 px high and its rim about 700 px long, in part occluded: a window that mixed
  // both sides would spoil some 8000 pixels.
  EXPECT_LT(between, 800);
}

TEST(SubpixelRefinement, LeavesUnmatchedPixelsUnmatched) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55), 0);
  Raster<float> initial = rounded(scene.disparity_px);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (int v = 50; v < 60; ++v)
    for (int u = 0; u < 320; ++u) initial.at(u, v) = nan;
  const auto map = refineDisparity(scene.left, scene.right, initial, {});
  for (int v = 50; v < 60; ++v)
    for (int u = 0; u < 320; ++u) {
      EXPECT_TRUE(std::isnan(map.disparity_px.at(u, v)));
      EXPECT_TRUE(std::isnan(map.sigma_px.at(u, v)));
    }
}

TEST(SubpixelRefinement, IsUnsureWhereThereIsNoTexture) {
  const GrayImage flat(96, 96, 120);
  const auto map = refineDisparity(flat, flat, Raster<float>(96, 96, 10.0f), {});
  for (const float d : map.disparity_px.values) EXPECT_TRUE(std::isnan(d));
}

}  // namespace
}  // namespace softscope
