// tests/features/lift_matches_test.cpp: pixels to points, exactly, and never across a step.
#include "features/lift_matches.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/scene.h"

namespace softscope {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

TEST(LiftMatches, IsExactOnASlantedPlane) {
  const auto scene = test::makeScene(test::endoscope(), test::plane(55, 0.5, -0.3));
  ModelView view;
  view.camera = scene.rig.left;
  view.world_from_left.pretranslate(Eigen::Vector3d(1, 2, 3));
  view.depth_mm = scene.depth_mm;
  view.point_index = Raster<std::int32_t>(320, 240, 42);
  const DepthMap live{scene.depth_mm, Raster<float>(320, 240, 0.25f)};
  const auto lifted =
      liftMatches({{{100, 90}, {103.3f, 88.8f}, 0.1f, 0.9f}}, view, live, scene.rig.left);
  ASSERT_EQ(lifted.size(), 1u);
  const Eigen::Vector3f source = lifted[0].source_world_mm - Eigen::Vector3f(1, 2, 3);
  const Eigen::Vector3f target = lifted[0].target_left_mm;
  EXPECT_NEAR(source.z(), 55 + 0.5 * source.x() - 0.3 * source.y(), 1e-4);  // floats at 55 mm
  EXPECT_NEAR(target.z(), 55 + 0.5 * target.x() - 0.3 * target.y(), 1e-4);
  EXPECT_NEAR(projectPoint<float>(scene.rig.left, target).x(), 103.3, 1e-4);
  EXPECT_EQ(lifted[0].model_point, 42);
  EXPECT_NEAR(lifted[0].across_mm, 0.1 * target.z() / scene.rig.left.fx_px, 1e-5);
  EXPECT_EQ(lifted[0].along_mm, 0.25f);
}

TEST(LiftMatches, DepthIsRefusedAcrossStepsHolesAndBorders) {
  Raster<float> depth(4, 3, 50.0f);
  depth.at(3, 0) = 53;
  depth.at(0, 2) = kNan;
  EXPECT_EQ(depthAt(depth, {1.5f, 0.5f}, 1), 50);
  EXPECT_TRUE(std::isnan(depthAt(depth, {2.5f, 0.5f}, 1)));
  EXPECT_GT(depthAt(depth, {2.5f, 0.5f}, 4), 50);  // a wider step is allowed
  EXPECT_TRUE(std::isnan(depthAt(depth, {0.5f, 1.5f}, 1)));
  EXPECT_EQ(depthAt(depth, {2, 2}, 1), 50);  // the last row has no row below
  EXPECT_TRUE(std::isnan(depthAt(depth, {-0.1f, 1}, 1)));
  EXPECT_TRUE(std::isnan(depthAt(depth, {3.01f, 1}, 1)));
  EXPECT_TRUE(std::isnan(depthAt(depth, {kNan, 1}, 1)));
  EXPECT_TRUE(std::isnan(depthAt({}, {0, 0}, 1)));
}

}  // namespace
}  // namespace softscope
