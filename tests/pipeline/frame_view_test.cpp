// tests/pipeline/frame_view_test.cpp: a flat piece of tissue, measured surely and unsurely.
#include "pipeline/frame/frame_view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/frame_record.h"

namespace softscope {
namespace {

constexpr int kWidth = 40, kHeight = 30;

MeasuredFrame measuredAt(float depth_mm, float sigma_mm) {
  MeasuredFrame measured;
  measured.left = ColourImage(kWidth, kHeight, Rgb8{120, 90, 80});
  measured.depth.depth_mm = Raster<float>(kWidth, kHeight, depth_mm);
  measured.depth.sigma_mm = Raster<float>(kWidth, kHeight, sigma_mm);
  measured.normals = NormalMap(kWidth, kHeight, -Eigen::Vector3f::UnitZ());
  return measured;
}

FrameView viewOf(MeasuredFrame measured) {
  RectifiedRig rig;
  rig.left = {kWidth, kHeight, 500, 500, 20, 15};
  rig.baseline_mm = 5;
  return viewFrame(std::move(measured), rig, ReconstructionOptions());
}

FrameView viewOf(float depth_mm, float sigma_mm) { return viewOf(measuredAt(depth_mm, sigma_mm)); }

TEST(FrameView, NearAndSureTissueHasTheLimitsOfTheSettings) {
  const ReconstructionOptions options;
  const FrameView view = viewOf(50, 0.05f);
  EXPECT_EQ(view.fusion.insertion.max_sigma_mm, options.fusion.insertion.max_sigma_mm);
  EXPECT_EQ(view.fusion.points.reference_sigma_mm, options.fusion.points.reference_sigma_mm);
}

TEST(FrameView, FusionComparesDepthsWithinTheirFrame) {
  EXPECT_NEAR(viewOf(50, 0.4f).fusion.points.reference_sigma_mm, 0.4, 1e-6);
}

TEST(FrameView, NewPointsNeedADisparityThatIsSureToAPixel) {
  const auto most_px = [](float sigma_mm) {  // a pixel is 1 mm
    return viewOf(50, sigma_mm).fusion.insertion.max_sigma_over_square_per_mm * 50 * 50;
  };
  EXPECT_NEAR(most_px(0.05f), 1, 1e-6);
  EXPECT_NEAR(most_px(0.6f), 1.8, 1e-6);  // or to three times what is typical
}

TEST(FrameView, UnsureDepthBendsTheModelLess) {
  EXPECT_EQ(viewOf(50, 0.4f).association.reference_sigma_mm,
            ReconstructionOptions().deform.association.reference_sigma_mm);
}

TEST(FrameView, LimitsFollowThePixelOfDisparity) {
  EXPECT_EQ(viewOf(50, 0.05f).summary.limit_scale, 1);
  EXPECT_NEAR(viewOf(100, 0.05f).summary.limit_scale, 100.0 * 100 / (500 * 5) / 2.5, 1e-6);
}

/// 0.3 mm in a quarter of the columns, 2 mm elsewhere.
MeasuredFrame mostlyUnsure() {
  MeasuredFrame measured = measuredAt(50, 2.0f);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; u += 4) measured.depth.sigma_mm.at(u, v) = 0.3f;
  return measured;
}

TEST(FrameView, WhereMostDepthsAreUnsureTheTypicalOneMakesPoints) {
  const FusionOptions options;
  const FrameView view = viewOf(mostlyUnsure());
  EXPECT_NEAR(view.fusion.insertion.max_sigma_mm, 2, 1e-6);
  EXPECT_NEAR(view.fusion.pixels.max_sigma_mm / view.fusion.insertion.max_sigma_mm,
              options.pixels.max_sigma_mm / options.insertion.max_sigma_mm, 1e-9);
}

TEST(FrameView, DepthIsPreciseIfItsErrorIsTolerableWith95PercentProbability) {
  EXPECT_EQ(viewOf(mostlyUnsure()).summary.precise_share, 0.25);
  EXPECT_EQ(viewOf(50, 0.51f).summary.precise_share, 1);  // 1 mm / 1.96
  EXPECT_EQ(viewOf(50, 0.52f).summary.precise_share, 0);
  MeasuredFrame without_sigma = measuredAt(50, 1);
  without_sigma.depth.sigma_mm = {};
  EXPECT_TRUE(std::isnan(viewOf(std::move(without_sigma)).summary.precise_share));
}

TEST(FrameRecord, ConfidenceIsTheSmallestOfAgreementAndPreciseShares) {
  FrameRecord record;
  record.status = FrameStatus::kFused;
  record.pose.found = true;
  record.evidence.view.depth_share = record.evidence.view.image_share = 1;
  EXPECT_EQ(record.confidence(), 1) << "depth without sigma";
  record.depth.precise_share = 0.3;
  EXPECT_EQ(record.confidence(), 0.3);
  record.evidence.view.depth_share = 0.2;
  EXPECT_EQ(record.confidence(), 0.2);
  record.precise_tracks_share = 0.1;
  EXPECT_EQ(record.confidence(), 0.1);
}

TEST(FrameRecord, HasAConfidenceOfAtMostOneHalfWithoutAPoseOfItsOwn) {
  FrameRecord record;
  record.status = FrameStatus::kFused;
  record.evidence.view.depth_share = record.evidence.view.image_share = 1;
  EXPECT_EQ(record.confidence(), 0.5);
  record.depth.precise_share = 0.3;
  EXPECT_EQ(record.confidence(), 0.3);
}

TEST(FrameRecord, TheFirstFrameHasTheConfidenceOfItsDepthAndPoints) {
  FrameRecord record;
  record.depth.precise_share = 0.3;
  record.status = FrameStatus::kStarted;
  EXPECT_EQ(record.confidence(), 0.3);
  record.precise_tracks_share = 0.2;
  EXPECT_EQ(record.confidence(), 0.2);
  record.status = FrameStatus::kLost;
  EXPECT_TRUE(std::isnan(record.confidence())) << "nothing was compared";
}

TEST(FrameView, CoverageIsOfTheTissueNotOfBlackBorders) {
  MeasuredFrame measured = measuredAt(50, 0.05f);
  measured.border = Mask(kWidth, kHeight);
  for (int v = 0; v < kHeight; ++v)
    for (int u = 0; u < kWidth; ++u) {
      const bool black = u < 8, unmeasured = v >= kHeight / 2;
      measured.border.at(u, v) = black ? 255 : 0;
      if (black || unmeasured) measured.depth.depth_mm.at(u, v) = std::nanf("");
    }
  measured.mask = measured.border;
  const FrameView view = viewOf(std::move(measured));
  EXPECT_EQ(view.summary.tissue_px, (kWidth - 8) * kHeight);
  EXPECT_EQ(view.summary.coverage(), 0.5) << "of the tissue the upper half has depth";
}

// A kidney in the distance, before nothing: the dark has no depth, and should have none.
TEST(FrameView, CoverageIsOfWhatLightReaches) {
  const auto seenTo = [](int lit_columns) {
    MeasuredFrame measured = measuredAt(50, 0.05f);
    for (int v = 0; v < kHeight; ++v)
      for (int u = lit_columns / 2; u < kWidth; ++u) {
        measured.depth.depth_mm.at(u, v) = std::nanf("");
        if (u >= lit_columns) measured.left.at(u, v) = Rgb8{9, 9, 9};
      }
    return viewOf(std::move(measured)).summary;
  };
  EXPECT_EQ(seenTo(20).tissue_px, 20 * kHeight);
  EXPECT_EQ(seenTo(20).coverage(), 0.5);
  EXPECT_EQ(seenTo(2).tissue_px, kWidth * kHeight / 5)
      << "a light in the dark is no view of tissue";
  EXPECT_EQ(seenTo(2).coverage(), 0.125);
}

}  // namespace
}  // namespace softscope
