// tests/stereo/row_alignment_test.cpp: a row error is found, told and removed.
#include "stereo/row_alignment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/scene.h"

namespace softscope {
namespace {

/// The right picture as a scope with a row error of shift + tilt (u - w/2) would deliver it.
test::Scene misaligned(double shift_px, double tilt_px_per_px) {
  const RectifiedRig rig = test::endoscope();
  test::Scene scene = test::makeScene(rig, test::plane(55, 0.2, 0.1), 1.0);
  RowAlignment inverse;
  inverse.shift_px = -shift_px;
  inverse.tilt_px_per_px = -tilt_px_per_px;
  ColourImage colour(rig.left.width_px, rig.left.height_px);
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const std::uint8_t gray = scene.right.values[i];
    colour.values[i] = {gray, gray, gray};
  }
  scene.right = toGray(removeRowError(colour, inverse));
  return scene;
}

TEST(RowAlignment, FindsNoErrorWhereThereIsNone) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100);
  ASSERT_TRUE(found.known());
  EXPECT_LT(found.mean_row_difference_px, 0.1);  // a parabola through correlations is that good
}

TEST(RowAlignment, MeasuresShiftAndTilt) {
  const auto scene = misaligned(1.6, 0.004);
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100);
  ASSERT_TRUE(found.known());
  // The tilt is felt at the right picture's column, about 25 px to the left of the corner.
  EXPECT_NEAR(found.shift_px, 1.6 - 25 * 0.004, 0.1);
  EXPECT_NEAR(found.tilt_px_per_px, 0.004, 0.0008);
  EXPECT_GT(found.mean_row_difference_px, 1.2);
  EXPECT_LT(found.residual_px, 0.15);
}

TEST(RowAlignment, RemovesWhatItFound) {
  const auto scene = misaligned(2.3, 0);
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100);
  ColourImage colour(scene.right.width_px, scene.right.height_px);
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const std::uint8_t gray = scene.right.values[i];
    colour.values[i] = {gray, gray, gray};
  }
  const RowAlignment after =
      measureRowAlignment(scene.left, toGray(removeRowError(colour, found)), 100);
  EXPECT_LT(after.mean_row_difference_px, 0.12);
}

TEST(RowAlignment, IsUnknownWithoutTexture) {
  const GrayImage flat(160, 120, 100);
  EXPECT_FALSE(measureRowAlignment(flat, flat, 64).known());
}

}  // namespace
}  // namespace softscope
