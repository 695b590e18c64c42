#include "stereo/refinement/uneven_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stereo/kernels/filter_formulas.h"
#include "stereo/matching/stereo_matcher.h"
#include "support/scene.h"

namespace softscope {
namespace {

constexpr int kSide = 40, kRadiusPx = 6;
const float kNan = std::numeric_limits<float>::quiet_NaN();

template <class Disparity>
DisparityMap mapOf(const Disparity& disparity) {
  DisparityMap map{Raster<float>(kSide, kSide), Raster<float>(kSide, kSide, 0.2f)};
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) map.disparity_px.at(u, v) = disparity(u, v);
  return map;
}

bool isKept(const DisparityMap& map, int u, int v) {
  const bool measured = !std::isnan(map.disparity_px.at(u, v));
  EXPECT_EQ(measured, !std::isnan(map.sigma_px.at(u, v)));
  return measured;
}

// Columns counted are 0, 2, 4 and 6 px from the centre: of seven, four are apart from it where the
// plane rises by 0.19 px per pixel, two where by 0.15.
TEST(UnevenWindows, AreThoseOfSteepPlanesInBothDirections) {
  for (const auto& [across, down, kept] :
       {std::tuple{0.15f, 0.0f, true}, std::tuple{0.19f, 0.0f, false},
        std::tuple{0.0f, -0.15f, true}, std::tuple{0.0f, 0.19f, false}}) {
    const auto plane = [across = across, down = down](int u, int v) {
      return 20 + across * static_cast<float>(u) + down * static_cast<float>(v);
    };
    DisparityMap map = mapOf(plane);
    dropUnevenWindows(kRadiusPx, &map);
    for (int v = kRadiusPx; v < kSide - kRadiusPx; ++v)
      for (int u = kRadiusPx; u < kSide - kRadiusPx; ++u) {
        EXPECT_EQ(isKept(map, u, v), kept) << across << ", " << down;
        if (kept) {
          EXPECT_EQ(map.disparity_px.at(u, v), plane(u, v));
        }
      }
  }
}

TEST(UnevenWindows, AreBesideAStep) {
  constexpr int kFrom = 20;
  DisparityMap map = mapOf([](int u, int) { return u < kFrom ? 10.0f : 12.0f; });
  dropUnevenWindows(kRadiusPx, &map);
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) {
      // Three of seven columns lie on the other side of the step, two 2 px farther away.
      const int apart = u < kFrom ? kFrom - u : u - kFrom + 1;
      EXPECT_EQ(isKept(map, u, v), apart > 2) << u;
    }
}

TEST(UnevenWindows, ASinglePixelMakesNone) {
  DisparityMap map = mapOf([](int u, int v) { return u == 20 && v == 20 ? 15.0f : 10.0f; });
  dropUnevenWindows(kRadiusPx, &map);
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) EXPECT_EQ(isKept(map, u, v), u != 20 || v != 20);
}

TEST(UnevenWindows, UnmeasuredPixelsDoNotCount) {
  DisparityMap map = mapOf([](int u, int v) { return (u + v) % 2 == 0 ? 10.0f : kNan; });
  dropUnevenWindows(kRadiusPx, &map);
  for (int v = 0; v < kSide; ++v)
    for (int u = 0; u < kSide; ++u) EXPECT_EQ(std::isnan(map.disparity_px.at(u, v)), (u + v) % 2);
  EXPECT_TRUE(isUneven(4, 10));
  EXPECT_FALSE(isUneven(3, 10));
  EXPECT_FALSE(isUneven(0, 0));
  EXPECT_FALSE(isApart(kNan, 10) || isApart(10, kNan));
}

TEST(UnevenWindows, ImagesMayBeSmallerThanAWindow) {
  DisparityMap map{Raster<float>(3, 1, 5.0f), Raster<float>(3, 1, 0.2f)};
  map.disparity_px.at(2, 0) = 7.0f;
  dropUnevenWindows(kRadiusPx, &map);
  EXPECT_FALSE(isKept(map, 0, 0));  // of the two pixels counted, one is apart
  EXPECT_TRUE(isKept(map, 1, 0));
  EXPECT_FALSE(isKept(map, 2, 0));
}

// A rim before tissue that is dim over 80 px: there, the prior is a ramp from one to the other.
TEST(SmallerSizes, MeasureNoRampBetweenTwoSurfaces) {
  constexpr double kNearMm = 45, kFarMm = 75, kRimMm = 0, kDimMm = 10.7;
  const auto step = [](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) {
    const double near = kNearMm / direction.z();
    return origin.x() + near * direction.x() < kRimMm ? near : kFarMm / direction.z();
  };
  test::Scene scene = test::makeScene(test::endoscope(480, 360), step, 2);
  const auto dim = [&](double offset_x_mm, GrayImage* image) {
    for (int v = 0; v < image->height_px; ++v)
      for (int u = 0; u < image->width_px; ++u) {
        const Eigen::Vector3d direction = liftPixel(scene.rig.left, double(u), double(v), 1.0);
        const Eigen::Vector3d hit = Eigen::Vector3d(offset_x_mm, 0, 0) +
                                    step(Eigen::Vector3d(offset_x_mm, 0, 0), direction) * direction;
        if (hit.z() < kFarMm - 1 || hit.x() > kDimMm) continue;
        image->at(u, v) = static_cast<std::uint8_t>(60 + (image->at(u, v) - 125) / 32);
      }
  };
  dim(0, &scene.left);
  dim(scene.rig.baseline_mm, &scene.right);
  const DisparityMap map = makeStereoMatcher(StereoOptions())->match(scene.left, scene.right, {});
  // At the full size, a window reaches 6 px beyond the rim.
  constexpr int kBeyondPx = 250, kDimUntilPx = 360;
  int measured = 0, wrong = 0;
  for (int v = 20; v < scene.left.height_px - 20; ++v)
    for (int u = kBeyondPx; u < kDimUntilPx; ++u) {
      const float apart = std::abs(map.disparity_px.at(u, v) - scene.disparity_px.at(u, v));
      measured += !std::isnan(apart);
      wrong += apart > 3;
    }
  EXPECT_GT(measured, 20000);
  EXPECT_LT(wrong, 0.01 * measured);
}

}  // namespace
}  // namespace softscope
