// tests/stereo/fringes_test.cpp: what is doubted at the end of a measured area.
#include "stereo/refinement/fringes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "stereo/kernels/filter_formulas.h"

namespace softscope {
namespace {

constexpr int kHalfSide = 60, kMeasuredTo = 30;
constexpr float kHalfSigma = 0.1F;
const float kNothing = std::numeric_limits<float>::quiet_NaN();

/// Columns up to kMeasuredTo are measured, with kHalfSigma; the image is bright up to `bright_to`.
struct HalfMeasured {
  explicit HalfMeasured(int bright_to, int bright = 150, int dark = 50)
      : left(kHalfSide, kHalfSide), map{Raster<float>(kHalfSide, kHalfSide, kNothing), {}} {
    for (int v = 0; v < kHalfSide; ++v)
      for (int u = 0; u < kHalfSide; ++u) {
        left.at(u, v) = static_cast<std::uint8_t>(u < bright_to ? bright : dark);
        if (u < kMeasuredTo) map.disparity_px.at(u, v) = 20;
      }
    map.sigma_px = map.disparity_px;
    for (float& sigma : map.sigma_px.values)
      if (!std::isnan(sigma)) sigma = kHalfSigma;
  }
  /// As it would be with rows for columns.
  HalfMeasured turned() const {
    HalfMeasured out = *this;
    for (int v = 0; v < kHalfSide; ++v)
      for (int u = 0; u < kHalfSide; ++u) {
        out.left.at(v, u) = left.at(u, v);
        out.map.disparity_px.at(v, u) = map.disparity_px.at(u, v);
        out.map.sigma_px.at(v, u) = map.sigma_px.at(u, v);
      }
    return out;
  }

  GrayImage left;
  DisparityMap map;
};

/// First and last measured column with a larger error, the same in all rows; (-1, -1) if there is
/// none.
std::pair<int, int> doubtedColumns(HalfMeasured half) {
  doubtFringes(half.left, &half.map);
  std::pair<int, int> doubted{-1, -1};
  for (int u = 0; u < kHalfSide; ++u) {
    const float sigma = half.map.sigma_px.at(u, 0);
    EXPECT_EQ(std::isnan(sigma), u >= kMeasuredTo) << u;
    for (int v = 0; v < kHalfSide && u < kMeasuredTo; ++v)
      EXPECT_EQ(half.map.sigma_px.at(u, v), sigma) << u << ", " << v;
    if (!(sigma > kHalfSigma)) continue;
    EXPECT_EQ(sigma, kRimStepPx) << u;
    doubted = {doubted.first < 0 ? u : doubted.first, u};
  }
  return doubted;
}

// Means of 3 x 3 pixels are of the dark side from the column after the first dark one.
TEST(Fringes, AreMeasuredPixelsThatLookLikeTheUnmeasured) {
  EXPECT_EQ(doubtedColumns(HalfMeasured(25)), std::pair(26, 29));
  EXPECT_EQ(doubtedColumns(HalfMeasured(25, 50, 150)), std::pair(26, 29));
  EXPECT_EQ(doubtedColumns(HalfMeasured(28)), std::pair(29, 29));
}

TEST(Fringes, EndWhereTheImageDoesNotChange) {
  EXPECT_EQ(doubtedColumns(HalfMeasured(kHalfSide)), std::pair(-1, -1));
  EXPECT_EQ(doubtedColumns(HalfMeasured(kMeasuredTo + 2)), std::pair(-1, -1));
  EXPECT_EQ(doubtedColumns(HalfMeasured(25, 100, 81)), std::pair(-1, -1));  // shading
  EXPECT_EQ(doubtedColumns(HalfMeasured(25, 100, 79)), std::pair(26, 29));
}

TEST(Fringes, AreNoWiderThanWindowsReach) {
  EXPECT_EQ(doubtedColumns(HalfMeasured(10)), std::pair(-1, -1));  // both sides are alike
  EXPECT_EQ(doubtedColumns(HalfMeasured(18)).first, kMeasuredTo - kFringeReachPx);
}

TEST(Fringes, AreTheSameInRowsAndColumns) {
  HalfMeasured upright(25), turned = upright.turned();
  doubtFringes(upright.left, &upright.map);
  doubtFringes(turned.left, &turned.map);
  const HalfMeasured back = turned.turned();
  for (std::size_t i = 0; i < upright.map.sigma_px.size(); ++i) {
    const float sigma = upright.map.sigma_px.values[i];
    if (!std::isnan(sigma)) ASSERT_EQ(back.map.sigma_px.values[i], sigma) << i;
  }
}

TEST(Fringes, LeaveALargerErrorAndTheBorderOfTheImage) {
  HalfMeasured half(25);
  for (float& sigma : half.map.sigma_px.values) sigma *= 50;
  const std::vector<float> before = half.map.sigma_px.values;
  doubtFringes(half.left, &half.map);
  for (std::size_t i = 0; i < before.size(); ++i)
    if (!std::isnan(before[i])) ASSERT_EQ(half.map.sigma_px.values[i], before[i]) << i;

  HalfMeasured whole(25);
  whole.map.disparity_px = Raster<float>(kHalfSide, kHalfSide, 20);
  whole.map.sigma_px = Raster<float>(kHalfSide, kHalfSide, kHalfSigma);
  doubtFringes(whole.left, &whole.map);
  for (const float sigma : whole.map.sigma_px.values) ASSERT_EQ(sigma, kHalfSigma);
}

TEST(Fringes, TakeAnImageWithoutMeasuredPixels) {
  HalfMeasured none(25);
  none.map.disparity_px = none.map.sigma_px = Raster<float>(kHalfSide, kHalfSide, kNothing);
  doubtFringes(none.left, &none.map);
  for (const float sigma : none.map.sigma_px.values) ASSERT_TRUE(std::isnan(sigma));
  DisparityMap nothing;
  doubtFringes({}, &nothing);
  EXPECT_EQ(nothing.sigma_px.size(), 0U);
}

}  // namespace
}  // namespace softscope
