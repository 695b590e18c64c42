// tests/toolkit/tattoo_marks_test.cpp: tattoos of STIR paired between both views.
#include "toolkit/benchmark/tattoo_marks.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/io/temporary_folder.h"

namespace softscope::test {
namespace {

/// f 1000 px, baseline 5 mm, principal points that differ by 10 px: 50 px of offset are 83.3 mm.
StereoCalibration stirScope() {
  StereoCalibration scope;
  scope.left.pinhole = {640, 512, 1000, 1000, 310, 250};
  scope.right.pinhole = {640, 512, 1000, 1000, 320, 250};
  scope.right_from_left.translation().x() = -5;
  return scope;
}

class TattooMarks : public testing::Test {
 protected:
  static TattooView emptyView() { return {Mask(640, 512, 0), GrayImage(640, 512, 20)}; }
  /// Square of 7 px with an infrared gradient along u or v.
  static void mark(int u, int v, bool along_u, TattooView* view) {
    for (int dv = 0; dv < 7; ++dv)
      for (int du = 0; du < 7; ++du) {
        view->segmentation.at(u + du, v + dv) = 255;
        view->infrared.at(u + du, v + dv) =
            static_cast<std::uint8_t>(100 + 20 * (along_u ? du : dv));
      }
  }
  std::vector<Eigen::Vector3d> positions() const {
    return tattooPositions(left_, right_, stirScope());
  }

  TattooView left_ = emptyView(), right_ = emptyView();
};

TEST_F(TattooMarks, PositionFollowsFromTheDisparityWithoutTheOffsetOfPrincipalPoints) {
  mark(407, 247, true, &left_);   // centre 410, 250
  mark(357, 249, true, &right_);  // 50 px to the left, 2 rows below
  ASSERT_EQ(positions().size(), 1u);
  const double depth_mm = 1000 * 5 / 60.0;
  EXPECT_TRUE(positions()[0].isApprox(Eigen::Vector3d(depth_mm * 0.1, 0, depth_mm)));
}

TEST_F(TattooMarks, OfSeveralCandidatesTheMostSimilarIsThePartner) {
  mark(407, 247, true, &left_);
  mark(357, 247, true, &right_);
  mark(337, 247, false, &right_);
  EXPECT_NEAR(positions()[0].z(), 1000 * 5 / 60.0, 1e-9);
}

TEST_F(TattooMarks, WithoutAPartnerThereIsNoPosition) {
  mark(407, 247, true, &left_);
  mark(357, 260, true, &right_);  // 13 rows below
  mark(409, 247, true, &right_);  // 8 px, 625 mm
  mark(227, 247, true, &right_);  // 190 px, 26 mm
  ASSERT_EQ(positions().size(), 1u);
  EXPECT_FALSE(positions()[0].allFinite());
}

TEST_F(TattooMarks, ARightMarkBelongsToTheMostSimilarLeftOne) {
  mark(407, 247, false, &left_);
  mark(427, 247, true, &left_);
  mark(357, 247, true, &right_);
  const auto found = positions();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_FALSE(found[0].allFinite());
  EXPECT_NEAR(found[1].z(), 1000 * 5 / 80.0, 1e-9);
}

TEST_F(TattooMarks, ImagesOfDifferentSizesAreRefused) {
  right_.infrared = GrayImage(320, 256, 0);
  expectError<InputError>([&] { positions(); }, {"differ in size"});
}

}  // namespace
}  // namespace softscope::test
