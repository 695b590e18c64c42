#include "stereo/refinement/uneven_windows.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stereo/kernels/filter_formulas.h"
#include "stereo/refinement/subpixel_refinement.h"
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

// Even of clear texture: the refinement cannot tell it from a ramp of the prior.
TEST(UnevenWindows, AreDroppedFromAQuarterOfTheSizeOn) {
  constexpr double kSteep = 2.75;  // 0.25 px of disparity per pixel
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, kSteep), 1.0);
  Raster<float> initial = scene.disparity_px;
  for (float& d : initial.values) d = std::round(d);
  const auto measuredShare = [&](int halvings) {
    RefinementOptions options;
    options.halvings = halvings;
    const DisparityMap map = refineDisparity(scene.left, scene.right, initial, options);
    int all = 0, measured = 0;
    for (int v = 40; v < 200; ++v)
      for (int u = 140; u < 180; ++u) {
        ++all;
        measured += !std::isnan(map.disparity_px.at(u, v));
      }
    return double(measured) / all;
  };
  EXPECT_GT(measuredShare(0), 0.8);
  EXPECT_GT(measuredShare(1), 0.8);
  EXPECT_EQ(measuredShare(2), 0);
}

}  // namespace
}  // namespace softscope
