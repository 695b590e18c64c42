// tests/pipeline/frame_view_test.cpp: a flat piece of tissue, measured surely and unsurely.
#include "pipeline/frame_view.h"

#include <gtest/gtest.h>

namespace softscope {
namespace {

constexpr int kWidth = 40, kHeight = 30;

FrameView viewOf(float depth_mm, float sigma_mm) {
  RectifiedRig rig;
  rig.left = {kWidth, kHeight, 500, 500, 20, 15};
  rig.baseline_mm = 5;
  MeasuredFrame measured;
  measured.left = ColourImage(kWidth, kHeight, Rgb8{120, 90, 80});
  measured.depth.depth_mm = Raster<float>(kWidth, kHeight, depth_mm);
  measured.depth.sigma_mm = Raster<float>(kWidth, kHeight, sigma_mm);
  measured.normals = NormalMap(kWidth, kHeight, -Eigen::Vector3f::UnitZ());
  return viewFrame(std::move(measured), rig, ReconstructionOptions());
}

TEST(FrameView, NearAndSureTissueHasTheLimitsOfTheSettings) {
  const ReconstructionOptions options;
  const FrameView view = viewOf(50, 0.05f);
  EXPECT_EQ(view.fusion.insertion.max_sigma_mm, options.fusion.insertion.max_sigma_mm);
  EXPECT_EQ(view.fusion.points.reference_sigma_mm, options.fusion.points.reference_sigma_mm);
}

TEST(FrameView, FusionComparesDepthsWithinTheirFrame) {
  EXPECT_NEAR(viewOf(50, 0.4f).fusion.points.reference_sigma_mm, 0.4, 1e-6);
}

TEST(FrameView, UnsureDepthBendsTheModelLess) {
  EXPECT_EQ(viewOf(50, 0.4f).association.reference_sigma_mm,
            ReconstructionOptions().deform.association.reference_sigma_mm);
}

TEST(FrameView, LimitsFollowThePixelOfDisparity) {
  EXPECT_EQ(viewOf(50, 0.05f).summary.limit_scale, 1);
  EXPECT_NEAR(viewOf(100, 0.05f).summary.limit_scale, 100.0 * 100 / (500 * 5) / 2.5, 1e-6);
}

}  // namespace
}  // namespace softscope
