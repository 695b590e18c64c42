// tests/stereo/rims_test.cpp: what is doubted beside the rim of a near surface.
#include "stereo/refinement/rims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

constexpr int kImageSide = 60;
const float kGap = std::numeric_limits<float>::quiet_NaN();

/// A near square of 20 x 20 pixels, unmeasured ones around it, then the surface behind.
Raster<float> squareBefore(float behind_px, int gap_px, float square_px = 30) {
  constexpr int kFrom = 20, kTo = 40;
  Raster<float> disparity_px(kImageSide, kImageSide, behind_px);
  const auto within = [](int u, int v, int margin) {
    return u >= kFrom - margin && u < kTo + margin && v >= kFrom - margin && v < kTo + margin;
  };
  for (int v = 0; v < kImageSide; ++v)
    for (int u = 0; u < kImageSide; ++u)
      if (within(u, v, gap_px)) disparity_px.at(u, v) = within(u, v, 0) ? square_px : kGap;
  return disparity_px;
}

constexpr float kSigma = 0.1F;

/// 1 where the error of a pixel was raised; empty if nowhere.
Mask doubted(const Raster<float>& disparity_px) {
  DisparityMap map{disparity_px, Raster<float>(disparity_px.width_px, disparity_px.height_px)};
  for (std::size_t i = 0; i < disparity_px.size(); ++i)
    map.sigma_px.values[i] = std::isnan(disparity_px.values[i]) ? kGap : kSigma;
  doubtRims(&map);
  Mask doubt(disparity_px.width_px, disparity_px.height_px, 0);
  bool any = false;
  for (std::size_t i = 0; i < disparity_px.size(); ++i) {
    const float sigma = map.sigma_px.values[i];
    EXPECT_EQ(std::isnan(sigma), std::isnan(disparity_px.values[i])) << i;
    if (std::isnan(sigma) || sigma == kSigma) continue;
    EXPECT_EQ(sigma, kRimStepPx) << i;
    doubt.values[i] = any = true;
  }
  return any ? doubt : Mask();
}

TEST(Rims, AreTheOutermostPixelsOfTheNearSurface) {
  for (const int gap_px : {0, 1, 12}) {
    const Raster<float> disparity_px = squareBefore(20, gap_px);
    const Mask at_rim = doubted(disparity_px);
    ASSERT_FALSE(at_rim.empty());
    for (int v = 0; v < kImageSide; ++v)
      for (int u = 0; u < kImageSide; ++u) {
        const bool is_near = disparity_px.at(u, v) == 30;
        const bool is_inner = u >= 25 && u < 35 && v >= 25 && v < 35;
        ASSERT_EQ(at_rim.at(u, v) != 0, is_near && !is_inner) << gap_px << ": " << u << ", " << v;
      }
  }
}

TEST(Rims, NeedASurfaceThatIsFartherWithinAWindow) {
  EXPECT_TRUE(doubted(squareBefore(27, 3)).empty());  // 3 px: one surface, steep
  EXPECT_FALSE(doubted(squareBefore(26.9F, 3)).empty());
  EXPECT_TRUE(doubted(squareBefore(20, 13)).empty());  // too far away
  EXPECT_TRUE(doubted(squareBefore(kGap, 3)).empty());
  EXPECT_TRUE(doubted(Raster<float>(kImageSide, kImageSide, kGap)).empty());
  EXPECT_TRUE(doubted({}).empty());
}

TEST(Rims, LeaveALargerError) {
  DisparityMap map{squareBefore(20, 1), Raster<float>(kImageSide, kImageSide, 5.0F)};
  doubtRims(&map);
  for (const float sigma : map.sigma_px.values) ASSERT_EQ(sigma, 5.0F);
}

// Behind a rim, what is measured is right as often as elsewhere.
TEST(Rims, LeaveTheSurfaceBehind) {
  const Raster<float> hole = squareBefore(30, 2, 20);  // the square is the farther one here
  const Mask at_rim = doubted(hole);
  ASSERT_FALSE(at_rim.empty());
  int near_px = 0;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    near_px += at_rim.values[i] != 0;
    if (hole.values[i] == 20) {
      ASSERT_EQ(at_rim.values[i], 0) << i;
    }
  }
  EXPECT_GT(near_px, 0);
}

}  // namespace
}  // namespace softscope
