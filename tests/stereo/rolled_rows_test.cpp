// tests/stereo/rolled_rows_test.cpp: rolled, zoomed and turned right cameras are found.
#include "stereo/rectification/rolled_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "stereo/rectification/row_alignment.h"
#include "stereo/rectification/view_synchrony.h"
#include "support/scene.h"

namespace softscope {
namespace {

constexpr double kRadPerDeg = 3.14159265358979 / 180;
constexpr int kRollRange = 100;  // disparities

const test::Scene& tissuePair() {
  static const test::Scene scene =
      test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  return scene;
}

/// The image whose pixel at x, y from the centre shows what the first has at from(x, y).
GrayImage warped(const GrayImage& image,
                 const std::function<std::pair<double, double>(double, double)>& from) {
  GrayImage out(image.width_px, image.height_px);
  const double cu = (image.width_px - 1) / 2.0, cv = (image.height_px - 1) / 2.0;
  for (int v = 0; v < image.height_px; ++v)
    for (int u = 0; u < image.width_px; ++u) {
      const auto [x, y] = from(u - cu, v - cv);
      const double column = std::clamp(cu + x, 0.0, image.width_px - 1.001);
      const double row = std::clamp(cv + y, 0.0, image.height_px - 1.001);
      const int u0 = static_cast<int>(column), v0 = static_cast<int>(row);
      const double fu = column - u0, fv = row - v0;
      const double value = (1 - fv) * ((1 - fu) * image.at(u0, v0) + fu * image.at(u0 + 1, v0)) +
                           fv * ((1 - fu) * image.at(u0, v0 + 1) + fu * image.at(u0 + 1, v0 + 1));
      out.at(u, v) = static_cast<std::uint8_t>(std::lround(value));
    }
  return out;
}

/// Rows grow towards the right: v_right - v_left = tan(roll) x.
GrayImage rolledBy(const GrayImage& image, double roll_rad) {
  const double c = std::cos(roll_rad), s = std::sin(roll_rad);
  return warped(image, [=](double x, double y) { return std::pair(c * x + s * y, c * y - s * x); });
}

GrayImage scaledBy(const GrayImage& image, double factor) {
  return warped(image, [=](double x, double y) { return std::pair(x / factor, y / factor); });
}

RowPlane rollOf(const GrayImage& right) {
  return findRolledRows(RowMeter(tissuePair().left, kRollRange), right);
}

SynchronyMeter clipOf(const GrayImage& right, int frames = 3) {
  const GrayImage flat(right.width_px, right.height_px, 100);
  SynchronyMeter meter(kRollRange);
  for (int i = 0; i < frames; ++i) meter.add(tissuePair().left, {flat, flat, right, flat, flat});
  return meter;
}

TEST(RolledRows, AreFoundToTenDegrees) {
  for (const double deg : {-9.5, -4.0, 3.0, 6.0, 9.5}) {
    const RowPlane rows = rollOf(rolledBy(tissuePair().right, deg * kRadPerDeg));
    EXPECT_NEAR(rows.per_column / std::tan(deg * kRadPerDeg), 1, 0.02) << deg;
    EXPECT_NEAR(rows.centre_px, 0, 0.1) << deg;
  }
}

TEST(RolledRows, AreNoneWhereRowsCorrespondOrNothingMatches) {
  EXPECT_FALSE(rollOf(tissuePair().right).isKnown());
  EXPECT_FALSE(rollOf(rolledBy(tissuePair().right, 0.5 * kRadPerDeg)).isKnown());
  EXPECT_FALSE(
      rollOf(GrayImage(tissuePair().left.width_px, tissuePair().left.height_px, 100)).isKnown());
  EXPECT_FALSE(rollOf(rolledBy(tissuePair().right, 90 * kRadPerDeg)).isKnown());
}

TEST(RolledRows, AreRemovedWhereExpected) {
  StereoPair pair{test::colourOf(tissuePair().left),
                  test::colourOf(rolledBy(tissuePair().right, 6 * kRadPerDeg))};
  const SynchronyMeter meter = clipOf(rolledBy(tissuePair().right, 6 * kRadPerDeg));
  const AlignedPair aligned = alignRows(std::move(pair), kRollRange, {}, meter.rowsAt(0));
  ASSERT_TRUE(aligned.removed);
  EXPECT_NEAR(aligned.roll_rad, std::tan(6 * kRadPerDeg), 0.003);
  const RowAlignment left_over =
      measureRowAlignment(aligned.left_gray, aligned.right_gray, kRollRange);
  EXPECT_GT(left_over.agreeing_share, 0.7);
  EXPECT_LT(left_over.mean_row_difference_px, 0.25);
}

TEST(RowDoubts, AreNoneForTheCamerasOfTheCalibration) {
  const RowDoubt doubt = clipOf(tissuePair().right).doubtAt(0);
  EXPECT_GT(doubt.matches, 1000);
  EXPECT_GT(doubt.agreeing_share, 0.8);
  EXPECT_FALSE(doubt.is_strong || doubt.is_scaled);
  EXPECT_FALSE(doubt.is_rolled);
  EXPECT_LT(std::abs(doubt.fan_px), 0.1);
}

TEST(RowDoubts, NameRollScaleAndYaw) {
  const RowDoubt rolled = clipOf(rolledBy(tissuePair().right, -5 * kRadPerDeg)).doubtAt(0);
  EXPECT_FALSE(rolled.is_strong);
  EXPECT_TRUE(rolled.is_rolled);
  EXPECT_NEAR(rolled.rollRad(), std::tan(-5 * kRadPerDeg), 0.002);

  const RowDoubt scaled = clipOf(scaledBy(tissuePair().right, 1.03)).doubtAt(0);
  EXPECT_FALSE(scaled.is_strong);
  EXPECT_TRUE(scaled.is_scaled);
  EXPECT_NEAR(scaled.scale(), 0.03, 0.004);

  constexpr double kFanPx = 3;
  const double half_px = tissuePair().left.width_px / 2.0;
  const GrayImage fanned = warped(tissuePair().right, [=](double x, double y) {
    return std::pair(x, y - kFanPx * x * y / (half_px * half_px));
  });
  EXPECT_NEAR(clipOf(fanned).doubtAt(0).fan_px, kFanPx, 0.4);
}

TEST(RowDoubts, AreStrongWhereMatchesAgreeByChance) {
  const test::Scene other = test::makeScene(test::endoscope(), test::sphere({30, 20, 90}, 40), 1.0);
  const RowDoubt doubt = clipOf(rolledBy(other.right, 25 * kRadPerDeg)).doubtAt(0);
  if (doubt.matches >= 50) {
    EXPECT_TRUE(doubt.is_strong);
  }
  EXPECT_FALSE(
      clipOf(GrayImage(other.left.width_px, other.left.height_px, 100)).doubtAt(0).is_strong)
      << "nothing matches, which is reported elsewhere";
}

}  // namespace
}  // namespace softscope
