// tests/features/shift_field_test.cpp: means where there are matches, the neighbours' where not.
#include "features/shift_field.h"

#include <gtest/gtest.h>

#include "features/match_pyramid.h"

namespace softscope {
namespace {

using Eigen::Vector2f;

PixelMatch matchAt(const Vector2f& model_px, const Vector2f& shift_px) {
  return {model_px, model_px + shift_px, 0.1f, 1};
}

TEST(ShiftField, IsZeroWithoutMatches) {
  EXPECT_EQ(ShiftField().at({3, 4}), Vector2f::Zero());
  EXPECT_EQ(ShiftField({}, 64, 64, 16).at({3, 4}), Vector2f::Zero());
}

TEST(ShiftField, TakesTheMeanOfASquare) {
  const ShiftField field({matchAt({20, 20}, {4, 0}), matchAt({28, 28}, {6, 2})}, 64, 64, 16);
  EXPECT_TRUE(field.at({23.5f, 23.5f}).isApprox(Vector2f(5, 1)));  // the centre of their square
}

TEST(ShiftField, FillsEmptySquaresFromTheSmallestBlockWithMatches) {
  const ShiftField field({matchAt({8, 8}, {2, 0}), matchAt({120, 120}, {10, 0})}, 128, 128, 16);
  EXPECT_TRUE(field.at({24, 8}).isApprox(Vector2f(2, 0)));
  EXPECT_TRUE(field.at({104, 120}).isApprox(Vector2f(10, 0)));
  EXPECT_TRUE(
      field.at({104, 8}).isApprox(Vector2f(6, 0)));  // a quarter without any: the mean of all
}

TEST(ShiftField, IsLinearBetweenSquares) {
  const ShiftField field({matchAt({8, 8}, {0, 0}), matchAt({24, 8}, {8, 4})}, 32, 16, 16);
  EXPECT_TRUE(field.at({15.5f, 8}).isApprox(Vector2f(4, 2)));
}

TEST(MatchPyramid, HalvesDownToTheLeastSide) {
  const MatchPicture picture{GrayImage(640, 480, 7), Mask(640, 480, 0)};
  const auto levels = matchPyramid(picture, picture, 96);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_EQ(levels[2].model.gray.width_px, 160);
  EXPECT_EQ(levels[2].live.ignore.height_px, 120);
  EXPECT_TRUE(levels[2].model.anchor.empty());
  EXPECT_EQ(levels[2].model.gray.at(80, 60), 7);
}

TEST(MatchPyramid, IgnoresACoarsePixelWithAnIgnoredOne) {
  MatchPicture picture{GrayImage(200, 200, 7), Mask(200, 200, 0)};
  picture.ignore.at(101, 60) = 255;
  const auto levels = matchPyramid(picture, picture, 96);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[1].live.ignore.at(50, 30), 1);
  EXPECT_EQ(levels[1].live.ignore.at(51, 30), 0);
}

TEST(MatchPyramid, FinerPixelsOfACoarsePlace) {
  const auto fine = toFinerLevel({matchAt({10, 20}, {3, 0})});
  EXPECT_EQ(fine[0].model_px, Vector2f(20.5f, 40.5f));  // the centre of the four fine pixels
  EXPECT_EQ(fine[0].live_px, Vector2f(26.5f, 40.5f));
  EXPECT_FLOAT_EQ(fine[0].sigma_px, 0.2f);
}

}  // namespace
}  // namespace softscope
