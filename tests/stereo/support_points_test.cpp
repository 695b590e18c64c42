// tests/stereo/support_points_test.cpp: points that need no help are right.
#include "stereo/matching/support_points.h"

#include <gtest/gtest.h>

#include "support/scene.h"

namespace softscope {
namespace {

std::vector<SupportPoint> pointsOf(const GrayImage& left, const GrayImage& right) {
  StereoOptions options;
  options.disparity_max_px = 100;
  const GradientImage l(left, options.elas.gradient_gain, options.disparity_max_px);
  const GradientImage r(right, options.elas.gradient_gain, options.disparity_max_px);
  return findSupportPoints(l, r, options);
}

TEST(SupportPoints, LieOnASlantedPlaneToAQuarterPixel) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.4, -0.2), 1.0);
  const auto points = pointsOf(scene.left, scene.right);
  ASSERT_GT(points.size(), 200u);
  int wrong = 0;
  for (const SupportPoint& p : points)
    wrong += std::abs(p.disparity_px - scene.disparity_px.at(p.u_px, p.v_px)) > 0.5f;
  // A parabola through three costs is accurate to a quarter pixel; beyond half is a mismatch.
  EXPECT_LE(wrong, static_cast<int>(points.size() / 100));
}

TEST(SupportPoints, ComeInRasterOrder) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55));
  const auto points = pointsOf(scene.left, scene.right);
  for (std::size_t i = 1; i < points.size(); ++i)
    EXPECT_LT(points[i - 1].v_px * 1000 + points[i - 1].u_px,
              points[i].v_px * 1000 + points[i].u_px);
}

TEST(SupportPoints, AreNotSeenInFlatOrUnrelatedPictures) {
  EXPECT_TRUE(pointsOf(GrayImage(160, 120, 90), GrayImage(160, 120, 90)).empty());
  const auto one = test::makeScene(test::endoscope(), test::plane(55), 0);
  const auto other = test::makeScene(test::endoscope(), test::plane(75, 0.9), 0);
  // Left and right of two scenes: of 3072 grid pixels few agree by chance and with neighbours.
  EXPECT_LT(pointsOf(one.left, other.right).size(), 100u);
}

TEST(NarrowedTo, HoldsWhatWasFoundAndLeavesStraysOut) {
  std::vector<float> found;
  for (int i = 0; i < 100; ++i) found.push_back(30 + 0.1f * static_cast<float>(i));
  found.push_back(200);
  const StereoOptions range = narrowedTo(found, StereoOptions().forWidth(640));
  EXPECT_LE(range.disparity_min_px, 25);  // surfaces go on a little beyond what was found
  EXPECT_GE(range.disparity_max_px, 45);
  EXPECT_LT(range.disparity_max_px, 80);
  for (int i = 0; i < 5; ++i) found.push_back(150);  // a small surface counts
  EXPECT_GE(narrowedTo(found, StereoOptions().forWidth(640)).disparity_max_px, 155);
}

TEST(NarrowedTo, NeedsEnoughPoints) {
  const StereoOptions range = narrowedTo({30, 30, 30, 30, 31}, StereoOptions().forWidth(640));
  EXPECT_EQ(range.disparity_min_px, 0);
  EXPECT_EQ(range.disparity_max_px, 255);
}

}  // namespace
}  // namespace softscope
