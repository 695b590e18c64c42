// tests/stereo/view_synchrony_test.cpp: views that were cut some pictures apart are found out.
#include "stereo/rectification/view_synchrony.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/scene.h"

namespace softscope {
namespace {

constexpr int kRows = 200;  // of a picture, out of 240

GrayImage pieceOf(const GrayImage& tall, int top) {
  GrayImage piece(tall.width_px, kRows);
  std::copy_n(tall.row(top), piece.size(), piece.row(0));
  return piece;
}

/// The row at which the picture of moment t begins, of a scope that moves up and down.
int topAt(int t, double reach_px) {
  return static_cast<int>(std::lround(20 + reach_px * std::sin(1.9 * t)));
}

/// The picture of that moment: another piece of a taller picture.
GrayImage momentOf(const GrayImage& tall, int t, double reach_px) {
  return pieceOf(tall, topAt(t, reach_px));
}

/// Frames 2 to `end` of a scope whose pictures begin at those rows; right picture f shows moment
/// f + late.
SynchronyMeter meterOf(const std::function<int(int)>& top_at, int end, int late) {
  static const test::Scene tall =
      test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  SynchronyMeter meter(100);
  for (int f = 2; f < end; ++f) {
    std::array<GrayImage, SynchronyMeter::kOffsets> rights;
    for (int k = 0; k < SynchronyMeter::kOffsets; ++k)
      rights[k] = pieceOf(tall.right, top_at(f + k - SynchronyMeter::kReach + late));
    meter.add(pieceOf(tall.left, top_at(f)), rights);
  }
  return meter;
}
SynchronyMeter meterOf(double reach_px, int late) {
  return meterOf([=](int t) { return topAt(t, reach_px); }, 6, late);
}
ViewSynchrony measure(double reach_px, int late) { return meterOf(reach_px, late).result(); }

TEST(ViewSynchrony, IsClearWhereOneOffsetAloneAgrees) {
  EXPECT_TRUE(meterOf(3, 0).isClear());
  EXPECT_FALSE(meterOf(3, 1).isClear());  // another one does
  EXPECT_FALSE(meterOf(0, 0).isClear());  // all do
  EXPECT_FALSE(SynchronyMeter(64).isClear());
}

TEST(ViewSynchrony, FindsAViewThatIsPicturesApart) {
  EXPECT_EQ(measure(3, 1).right_offset, -1);
  EXPECT_EQ(measure(3, -2).right_offset, 2);
}

/// The scope moves by a row, once: one frame of eight has fewer matches without the offset.
TEST(ViewSynchrony, FindsItInSlowMotionToo) {
  const auto top_at = [](int t) { return t < 7 ? 20 : 21; };
  EXPECT_EQ(meterOf(top_at, 10, 1).result().right_offset, -1);
}

TEST(ViewSynchrony, LeavesAClipInStepAsItIs) {
  const ViewSynchrony found = measure(3, 0);
  EXPECT_EQ(found.right_offset, 0);
  EXPECT_EQ(found.agreeing, found.agreeing_as_is);
  EXPECT_GT(found.agreeing, 1000);
}

/// More matches agree with rows two pictures earlier, which have no noise; but in one of the
/// frames, the scope had moved by then.
TEST(ViewSynchrony, IsNotThatOfEasierMatchesOfOtherMoments) {
  const test::Surface tissue = test::plane(55, 0.2, 0.1);
  const test::Scene clean = test::makeScene(test::endoscope(), tissue);
  const test::Scene noisy = test::makeScene(test::endoscope(), tissue, 10);
  const GrayImage flat(clean.left.width_px, kRows, 100);
  SynchronyMeter meter(100);
  for (int f = 0; f < 5; ++f) {
    const GrayImage earlier = momentOf(clean.right, f == 2 ? 1 : 0, 4);
    meter.add(momentOf(clean.left, 0, 4), {earlier, flat, momentOf(noisy.right, 0, 4), flat, flat});
  }
  const ViewSynchrony found = meter.result();
  EXPECT_EQ(found.right_offset, 0);
  EXPECT_GT(found.agreeing, 200);
}

/// Rows two pictures earlier have more matches and less scatter, but do not agree either.
TEST(ViewSynchrony, IsNoneWhereRowsDisagreeAtEveryOffset) {
  const test::Scene scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  const GrayImage flat(scene.left.width_px, kRows, 100);
  SynchronyMeter meter(100);
  for (int f = 0; f < 6; ++f) {
    const GrayImage earlier = momentOf(scene.right, f < 4 ? 0 : 1, 2);
    const GrayImage same = momentOf(scene.right, f, 4);
    meter.add(momentOf(scene.left, 0, 4), {earlier, flat, same, flat, flat});
  }
  const ViewSynchrony found = meter.result();
  EXPECT_EQ(found.right_offset, 0);
  EXPECT_GT(found.agreeing, 200);
}

TEST(ViewSynchrony, HasTheRowsThatAllFramesHaveInCommon) {
  const test::Scene scene = test::makeScene(test::endoscope(), test::plane(55, 0.2, 0.1), 1.0);
  SynchronyMeter meter(100);
  for (int f = 0; f < 2; ++f) {
    const GrayImage right = pieceOf(scene.right, 20), flat(right.width_px, kRows, 100);
    meter.add(pieceOf(scene.left, 17), {flat, flat, right, flat, flat});
  }
  const RowPlane rows = meter.rowsAt(0);
  EXPECT_NEAR(rows.centre_px, -3, 0.05);
  EXPECT_NEAR(rows.per_column, 0, 0.0005);
  EXPECT_NEAR(rows.per_row, 0, 0.0005);
  EXPECT_EQ(meter.rowsAt(1).centre_px, 0) << "unknown";
}

TEST(ViewSynchrony, IsUnknownWithoutMotionOrTexture) {
  EXPECT_EQ(measure(0, 1).right_offset, 0);
  SynchronyMeter meter(64);
  const GrayImage flat(160, 120, 100);
  meter.add(flat, {flat, flat, flat, flat, flat});
  EXPECT_EQ(meter.result().right_offset, 0);
  EXPECT_EQ(SynchronyMeter(64).result().right_offset, 0);
}

}  // namespace
}  // namespace softscope
