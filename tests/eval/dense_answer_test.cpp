#include "eval/images/dense_answer.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(DenseAnswer, HolesTakeTheNearestMeasuredPixel) {
  Raster<float> depth_mm(5, 2, kNan);
  depth_mm.at(0, 0) = 10;
  depth_mm.at(4, 0) = 20;
  const Raster<float> filled = fillFromNearest(depth_mm);
  EXPECT_EQ(filled.at(1, 0), 10);
  EXPECT_EQ(filled.at(3, 1), 20);
  EXPECT_TRUE(std::isnan(fillFromNearest(Raster<float>(2, 2, kNan)).at(1, 1)));
}

TEST(DenseAnswer, APixelBehindANearerSurfaceOrOutsideTheRightImageIsHidden) {
  Raster<float> disparity_px(8, 1, 2);
  disparity_px.at(6, 0) = 4;  // nearer: falls on column 2, as pixel 4 does
  disparity_px.at(7, 0) = kNan;
  const Mask hidden = hiddenInRight(disparity_px);
  const std::vector<std::uint8_t> expected{1, 1, 0, 0, 1, 0, 0, 0};
  EXPECT_EQ(std::vector<std::uint8_t>(hidden.values.begin(), hidden.values.end()), expected);
}

}  // namespace
}  // namespace softscope
