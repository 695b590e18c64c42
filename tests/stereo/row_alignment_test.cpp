// tests/stereo/row_alignment_test.cpp: a row error is found, told and removed.
#include "stereo/rectification/row_alignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "stereo/rectification/row_meter.h"
#include "stereo/rectification/row_model.h"
#include "support/scene.h"

namespace softscope {
namespace {

/// The right picture as a scope with a row error of shift + tilt (u - w/2) would deliver it.
test::Scene misaligned(double shift_px, double tilt_px_per_px, double noise_gray = 1) {
  const RectifiedRig rig = test::endoscope();
  test::Scene scene = test::makeScene(rig, test::plane(55, 0.2, 0.1), noise_gray);
  RowAlignment inverse;
  inverse.half_width_px = rig.left.width_px / 2.0;
  inverse.centre_u_px = rig.left.cx_px;
  inverse.model[0] = -shift_px;
  inverse.model[1] = -tilt_px_per_px * inverse.half_width_px;
  scene.right = toGray(removeRowError(test::colourOf(scene.right), inverse));
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
  EXPECT_NEAR(found.shift_px(), 1.6, 0.1);
  EXPECT_NEAR(found.tilt_px_per_px(), 0.004, 0.0008);
  EXPECT_GT(found.mean_row_difference_px, 1.2);
  EXPECT_LT(found.residual_px, 0.15);
}

TEST(RowAlignment, RemovesWhatItFound) {
  const auto scene = misaligned(2.3, 0.003);
  const AlignedPair aligned =
      alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100);
  EXPECT_TRUE(aligned.removed);
  EXPECT_NEAR(aligned.before.mean_row_difference_px, 2.3, 0.2);
  const RowAlignment after = measureRowAlignment(scene.left, toGray(aligned.pair.right), 100);
  EXPECT_LT(after.mean_row_difference_px, 0.12);
}

/// An organ of a third of the image does not show the roll of its calibration.
TEST(RowAlignment, OfASmallOrganIsThatOfItsClip) {
  test::Scene scene = misaligned(0, 0.006, 3);
  const int third = scene.left.width_px / 3;
  for (GrayImage* image : {&scene.left, &scene.right})
    for (int v = 0; v < image->height_px; ++v)
      for (int u = 0; u < image->width_px; ++u)
        if (u < third || u >= 2 * third) image->at(u, v) = 20;
  const auto tilt = [&](const RowPlane& expected) {
    return alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100, {}, expected)
        .roll_rad;
  };
  EXPECT_LT(std::abs(tilt({})), 0.003);
  EXPECT_NEAR(tilt({0, 0.006, 0}), 0.006, 0.0008);
  EXPECT_EQ(tilt({0, 0.0005, 0}), 0) << "too small to count";
}

TEST(RowAlignment, FindsRowsEightPixelsOff) {
  for (const double shift_px : {-8.0, 8.0}) {
    const auto scene = misaligned(shift_px, 0);
    const AlignedPair aligned =
        alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100);
    ASSERT_TRUE(aligned.removed);
    EXPECT_NEAR(aligned.before.shift_px(), shift_px, 0.2);
    const RowAlignment after = measureRowAlignment(scene.left, toGray(aligned.pair.right), 100);
    EXPECT_LT(after.mean_row_difference_px, 0.15);
  }
}

TEST(RowAlignment, TriesTheExpectedRowsFirst) {
  const auto scene = misaligned(7.6, 0.002);
  for (const RowPlane& expected : {RowPlane{7.6, 0.002, 0}, RowPlane{6.5, 0, 0}}) {
    const AlignedPair aligned =
        alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100, {}, expected);
    ASSERT_TRUE(aligned.removed);
    EXPECT_NEAR(aligned.before.shift_px(), 7.6, 0.2);
    const RowAlignment after = measureRowAlignment(scene.left, toGray(aligned.pair.right), 100);
    EXPECT_LT(after.mean_row_difference_px, 0.15);
  }
}

/// Columns and rows around the centre.
GrayImage middleOf(const GrayImage& image, int width_px, int height_px) {
  GrayImage middle(width_px, height_px);
  for (int v = 0; v < height_px; ++v)
    for (int u = 0; u < width_px; ++u)
      middle.at(u, v) =
          image.at(u + (image.width_px - width_px) / 2, v + (image.height_px - height_px) / 2);
  return middle;
}

// Every 12 px, such an image has too few pixels to match.
TEST(RowAlignment, MatchesMorePixelsOfASmallImage) {
  const auto scene = misaligned(3.5, 0);
  const RowAlignment found =
      measureRowAlignment(middleOf(scene.left, 128, 96), middleOf(scene.right, 128, 96), 60);
  ASSERT_TRUE(found.known());
  EXPECT_NEAR(found.at(64, 48), 3.5, 0.2);
}

/// A third of the contrast, and noise.
void weaken(unsigned seed, GrayImage* image) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 3);
  for (std::uint8_t& gray : image->values)
    gray = static_cast<std::uint8_t>(std::lround(90 + (gray - 90) / 3.0 + noise(random)));
}

/// Matches to a quarter of a pixel, of weak texture whose rows are off by `shift_px`.
long rightMatches(double shift_px) {
  test::Scene scene = misaligned(shift_px, 0);
  weaken(1, &scene.left);
  weaken(2, &scene.right);
  const std::vector<RowMatch> found = RowMeter(scene.left, 100).match(scene.right);
  return std::count_if(found.begin(), found.end(), [&](const RowMatch& match) {
    return std::abs(match.difference_px - shift_px) < 0.25;
  });
}

// One row off, such texture has a quarter of the matches, and every second row is tried.
TEST(RowMeter, MatchesWeakTextureInOddRowsAsInEvenOnes) {
  const auto even = static_cast<double>(rightMatches(2));
  EXPECT_GT(even, 150);
  for (const double odd_px : {-3, -1, 1, 3})
    EXPECT_GT(static_cast<double>(rightMatches(odd_px)), 0.75 * even) << odd_px;
}

/// Straight edges over the left half, at the same disparity in any row: an instrument, magnified.
void cover(double shift_px, double disparity_px, GrayImage* image) {
  constexpr double kSlopePx = 1.76;  // to the right with each row
  for (int v = 0; v < image->height_px; ++v)
    for (int u = 0; u < image->width_px / 2; ++u) {
      const double across_px = u + disparity_px - kSlopePx * (v - shift_px);
      image->at(u, v) = static_cast<std::uint8_t>(
          std::lround(40 + 170 * test::solidTexture({across_px, 0, 0}, 7)));
    }
}

/// Edges look alike in every row, and would confirm the first one that is tried.
TEST(RowMeter, TakesNoRowFromAStraightEdge) {
  constexpr double kShiftPx = 2.5;
  test::Scene scene = misaligned(kShiftPx, 0);
  cover(0, 0, &scene.left);
  cover(kShiftPx, 40, &scene.right);
  const std::vector<RowMatch> matches = RowMeter(scene.left, 100).match(scene.right);
  const auto right = std::count_if(matches.begin(), matches.end(), [](const RowMatch& match) {
    return std::abs(match.difference_px - kShiftPx) < 0.5;
  });
  EXPECT_GT(right, 300);
  EXPECT_GT(static_cast<double>(right), 0.8 * static_cast<double>(matches.size()));
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100);
  for (const int u : {80, 240}) EXPECT_NEAR(found.at(u, 120), kShiftPx, 0.2) << u;
}

/// Noise alone must not send the search to rows that cannot be the true ones.
TEST(RowMeter, LooksNoFartherForNoiseAlone) {
  const test::Scene scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 9);
  double sum_px = 0, farthest_px = 0;
  const std::vector<RowMatch> matches = RowMeter(scene.left, 100).match(scene.right);
  for (const RowMatch& match : matches) {
    sum_px += std::abs(match.difference_px);
    farthest_px = std::max(farthest_px, std::abs(match.difference_px));
  }
  EXPECT_GT(sum_px, RowAlignment::kRemoveAbovePx * static_cast<double>(matches.size()));
  EXPECT_LE(farthest_px, 1.5);  // of its own row and the two beside it
  const RowAlignment found = measureRowAlignment(scene.left, scene.right, 100);
  ASSERT_TRUE(found.known());
  EXPECT_NEAR(found.shift_px(), 0, 0.05);
}

TEST(RowAlignment, TellsARollByTheTiltOfTheRows) {
  const auto scene = misaligned(5, 0.0087);  // half a degree: 2.8 px at either side
  const AlignedPair aligned =
      alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100);
  EXPECT_NEAR(aligned.roll_rad, 0.0087, 0.0008);
  EXPECT_EQ(alignRows({test::colourOf(scene.left), test::colourOf(scene.left)}, 100).roll_rad, 0);
}

/// Noise, too, sets rows apart: what is left of them is no less than most of it.
TEST(RowAlignment, RemovesASmallRollFromNoisyPictures) {
  const auto scene = misaligned(0.25, 0.0024, 8);
  const AlignedPair aligned =
      alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100);
  EXPECT_LT(aligned.before.mean_row_difference_px - aligned.before.residual_px, 0.1);
  EXPECT_TRUE(aligned.removed);
  EXPECT_NEAR(aligned.roll_rad, 0.0024, 0.0005);  // 0.08 px at either side
}

TEST(RowAlignment, LeavesAlignedPicturesAsTheyAre) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  const AlignedPair aligned =
      alignRows({test::colourOf(scene.left), test::colourOf(scene.right)}, 100);
  EXPECT_FALSE(aligned.removed);
  EXPECT_EQ(aligned.pair.right.values, test::colourOf(scene.right).values);
}

RowAlignment pictureOf(int width_px, int height_px) {
  RowAlignment picture;
  picture.half_width_px = width_px / 2.0;
  picture.centre_u_px = (width_px - 1) / 2.0;
  picture.centre_v_px = (height_px - 1) / 2.0;
  return picture;
}

TEST(RowModel, DoesNotFollowItsSlopeWhereNothingWasMatched) {
  const RowAlignment picture = pictureOf(640, 480);
  std::vector<RowMatch> matches;  // an organ at the left moved between the exposures
  for (int u = 5; u < 200; u += 12)
    for (int v = 5; v < 480; v += 12) matches.push_back({1.0 * u, 1.0 * v, 2.0 - 0.01 * u});
  const RowAlignment model = fitRowModel(matches, picture);
  EXPECT_NEAR(model.at(100, 240), 1.0, 0.2);
  // The line through the matches would give -4.4 px here.
  EXPECT_LT(std::abs(model.at(639, 240)), 1.0);
}

TEST(RowModel, IsDrawnToTheExpectedRowsWhereNothingWasMatched) {
  const RowAlignment picture = pictureOf(640, 480);
  const RowPlane expected{1.5, -0.004, 0.002};
  const auto expected_px = [&](double u, double v) {
    return 1.5 - 0.004 * (u - picture.centre_u_px) + 0.002 * (v - picture.centre_v_px);
  };
  std::vector<RowMatch> matches;  // of one part
  for (int u = 205; u < 440; u += 12)
    for (int v = 205; v < 400; v += 12)
      matches.push_back({1.0 * u, 1.0 * v, expected_px(u, v) + 0.05 * ((u + 3 * v) % 7 - 3)});
  const RowAlignment model = fitRowModel(matches, picture, expected);
  ASSERT_TRUE(model.known());
  for (const int u : {0, 639})
    for (const int v : {0, 479}) EXPECT_NEAR(model.at(u, v), expected_px(u, v), 0.1);
  EXPECT_GT(std::abs(fitRowModel(matches, picture).at(0, 240) - expected_px(0, 240)), 0.5)
      << "one part alone does not tell";
  double mean_px = 0;
  for (const RowMatch& m : matches) mean_px += std::abs(m.difference_px);
  EXPECT_NEAR(model.mean_row_difference_px, mean_px / static_cast<double>(matches.size()), 1e-9);
  // What matches show counts more than what is expected.
  EXPECT_NEAR(fitRowModel(matches, picture, {0.5, 0.004, 0}).at(320, 300), expected_px(320, 300),
              0.1);
}

TEST(RowPlane, IsThatOfMostMatches) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise_px(0, 0.2);
  std::uniform_real_distribution<double> any_px(-8, 8);
  std::vector<RowMatch> matches;
  for (int u = 100; u < 260; u += 6)
    for (int v = 80; v < 220; v += 6) {
      const double true_px = -2 + 0.005 * (u - 179.5) - 0.001 * (v - 143.5);
      const bool is_wrong = (u / 6 + v / 6) % 4 == 0;
      matches.push_back({1.0 * u, 1.0 * v, is_wrong ? any_px(random) : true_px + noise_px(random)});
    }
  const RowPlane plane = fitRowPlane(matches, pictureOf(360, 288));
  EXPECT_NEAR(plane.centre_px, -2, 0.05);
  EXPECT_NEAR(plane.per_column, 0.005, 0.0006);
  EXPECT_NEAR(plane.per_row, -0.001, 0.0006);
}

/// A calibration with rows that differ by 2.5 px, of which weak texture shows a part.
TEST(RowModel, FollowsWhatItsMatchesHaveInCommon) {
  const RowAlignment picture = pictureOf(360, 288);
  std::vector<RowMatch> matches;
  for (int u = 250; u < 340; u += 10)
    for (int v = 20; v < 130; v += 10)
      matches.push_back({1.0 * u, 1.0 * v, -2.5 + 0.1 * ((u + 3 * v) % 70 / 10 - 3)});
  const RowAlignment model = fitRowModel(matches, picture);
  for (const int u : {0, 179, 359})
    for (const int v : {0, 143, 287}) EXPECT_NEAR(model.at(u, v), -2.5, 0.25) << u << " " << v;
}

/// Weak texture: at one side most of the matches are wrong.
TEST(RowModel, IsNotBentByWrongMatches) {
  const RowAlignment picture = pictureOf(360, 288);
  const auto true_px = [](int u) { return 3.2 - 0.0049 * (u - 179.5); };
  std::mt19937 random(1);
  std::normal_distribution<double> noise_px(0, 0.2);
  std::uniform_real_distribution<double> any_px(2, 8);
  std::vector<RowMatch> matches;
  for (int u = 5; u < 360; u += 10)
    for (int v = 5; v < 288; v += 20) {
      matches.push_back({1.0 * u, 1.0 * v, true_px(u) + noise_px(random)});
      for (int wrong = 0; u > 240 && wrong < 3; ++wrong)
        matches.push_back({1.0 * u, 1.0 * v, any_px(random)});
    }
  const RowAlignment model = fitRowModel(matches, picture);
  for (const int u : {20, 179, 340}) EXPECT_NEAR(model.at(u, 143), true_px(u), 0.15) << u;
}

TEST(RowAlignment, IsUnknownWithoutTexture) {
  const GrayImage flat(160, 120, 100);
  EXPECT_FALSE(measureRowAlignment(flat, flat, 64).known());
}

}  // namespace
}  // namespace softscope
