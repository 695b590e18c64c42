// tests/stereo/disparity_filter_test.cpp: small cases by hand.
#include "stereo/refinement/disparity_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace softscope {
namespace {

const float kNaN = std::numeric_limits<float>::quiet_NaN();

TEST(CheckLeftRight, KeepsWhatBothPicturesSay) {
  Raster<std::int16_t> left(10, 1, -1), right(10, 1, -1);
  left.values = {0, 3, 3, 3, 3, 3, 3, -1, 3, 3};
  right.values = {3, 3, 4, 5, -1, 3, 3, 0, 0, 0};
  const auto checked = checkLeftRight(left, right, 1);
  // u = 3: right(0) = 3 agrees; u = 5: right(2) = 4 agrees to 1; u = 6: right(3) = 5 doesn't.
  EXPECT_TRUE(std::isnan(checked.at(0, 0)));  // right(0) is 3, not 0
  EXPECT_TRUE(std::isnan(checked.at(1, 0)));  // its match is outside
  EXPECT_EQ(checked.at(3, 0), 3);
  EXPECT_EQ(checked.at(4, 0), 3);
  EXPECT_EQ(checked.at(5, 0), 3);
  EXPECT_TRUE(std::isnan(checked.at(6, 0)));
  EXPECT_TRUE(std::isnan(checked.at(7, 0)));  // unmatched in the left picture
  EXPECT_EQ(checked.at(8, 0), 3);
}

TEST(RemoveSpeckles, RemovesIslandsAndKeepsCoasts) {
  Raster<float> d(20, 20, 10.0f);
  for (int v = 5; v < 8; ++v)
    for (int u = 5; u < 8; ++u) d.at(u, v) = 30;  // an island of 9
  d.at(0, 0) = kNaN;
  removeSpeckles(d, 10, 1.0);
  EXPECT_TRUE(std::isnan(d.at(6, 6)));
  EXPECT_TRUE(std::isnan(d.at(0, 0)));
  EXPECT_EQ(d.at(15, 15), 10);
  removeSpeckles(d, 391, 1.0);  // 400 - 9 - 1 = 390 pixels are left
  EXPECT_TRUE(std::isnan(d.at(15, 15)));
}

TEST(FillGaps, InterpolatesNarrowGapsOnly) {
  Raster<float> d(12, 1, kNaN);
  d.at(0, 0) = 10;
  d.at(3, 0) = 11.5f;  // gap of 2
  d.at(8, 0) = 12;     // gap of 4: too wide
  d.at(10, 0) = 40;    // gap of 1: too steep
  fillGaps(d, 3, 2.0);
  EXPECT_FLOAT_EQ(d.at(1, 0), 10.5f);
  EXPECT_FLOAT_EQ(d.at(2, 0), 11.0f);
  EXPECT_TRUE(std::isnan(d.at(5, 0)));
  EXPECT_TRUE(std::isnan(d.at(9, 0)));
  EXPECT_TRUE(std::isnan(d.at(11, 0)));  // beyond the last measured pixel nothing is made up
}

TEST(FillGaps, FillsColumnsToo) {
  Raster<float> d(1, 5, kNaN);
  d.at(0, 1) = 4;
  d.at(0, 3) = 5;
  fillGaps(d, 3, 2.0);
  EXPECT_FLOAT_EQ(d.at(0, 2), 4.5f);
  EXPECT_TRUE(std::isnan(d.at(0, 0)));
}

TEST(ErodeEdges, RemovesBothSidesOfAStepAndTheBorder) {
  DisparityMap map{Raster<float>(20, 10, 10.0f), Raster<float>(20, 10, 0.1f)};
  for (int v = 0; v < 10; ++v)
    for (int u = 10; u < 20; ++u) map.disparity_px.at(u, v) = 20;
  erodeEdges(map, 1, 2.0, 2);
  EXPECT_TRUE(std::isnan(map.disparity_px.at(9, 5)));
  EXPECT_TRUE(std::isnan(map.disparity_px.at(10, 5)));
  EXPECT_EQ(map.disparity_px.at(8, 5), 10);
  EXPECT_EQ(map.disparity_px.at(11, 5), 20);
  EXPECT_TRUE(std::isnan(map.disparity_px.at(1, 5)));
  EXPECT_EQ(map.disparity_px.at(2, 5), 10);
  EXPECT_TRUE(std::isnan(map.sigma_px.at(9, 5)));
}

TEST(RemoveDark, RemovesDarkPixelsAndTheirNeighbours) {
  Raster<float> d(20, 20, 10.0f);
  GrayImage left(20, 20, 100);
  left.at(10, 10) = 4;
  removeDark(d, left, 10, 2);
  EXPECT_TRUE(std::isnan(d.at(12, 8)));
  EXPECT_EQ(d.at(13, 10), 10);
}

}  // namespace
}  // namespace softscope
