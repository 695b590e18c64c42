// tests/stereo/depth_from_disparity_test.cpp: depth, its error and normals by closed formulas.
#include "stereo/depth/depth_from_disparity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/scene.h"

namespace softscope {
namespace {

TEST(DepthFromDisparity, IsFocalTimesBaselineOverDisparity) {
  RectifiedRig rig = test::endoscope(640, 480);
  rig.disparity_offset_px = 6;
  DisparityMap map{Raster<float>(2, 2, 44.0f), Raster<float>(2, 2, 0.1f)};
  map.disparity_px.at(1, 0) = std::numeric_limits<float>::quiet_NaN();
  map.disparity_px.at(0, 1) = -6;  // at infinity
  map.disparity_px.at(1, 1) = -9;  // behind the camera
  const DepthMap depth = depthFromDisparity(map, rig);
  EXPECT_FLOAT_EQ(depth.depth_mm.at(0, 0), 560 * 5.0f / 50);
  EXPECT_NEAR(depth.sigma_mm.at(0, 0), 56.0 / 50 * 0.1, 1e-5);  // z / d per pixel
  for (const auto& [u, v] : {std::pair{1, 0}, {0, 1}, {1, 1}})
    EXPECT_TRUE(std::isnan(depth.depth_mm.at(u, v)));
  EXPECT_NEAR(rig.disparityPx(rig.depthMm(44)), 44, 1e-12);
}

TEST(NormalsFromDepth, AreExactOnAPlane) {
  const RectifiedRig rig = test::endoscope(160, 120);
  const auto scene = test::makeScene(rig, test::plane(60, 0.5, -0.25));
  const NormalMap normals = normalsFromDepth(scene.depth_mm, rig.left);
  // z = 60 + 0.5 x - 0.25 y: the normal towards the camera is (0.5, -0.25, -1).
  const Eigen::Vector3f expected = Eigen::Vector3f(0.5f, -0.25f, -1).normalized();
  for (int v = 5; v < 115; v += 10)
    for (int u = 5; u < 155; u += 10)
      EXPECT_LT((normals.at(u, v) - expected).norm(), 1e-3f);  // float depth: 1e-4 mm at 60 mm
}

TEST(NormalsFromDepth, PointOutwardsOnASphere) {
  const RectifiedRig rig = test::endoscope(160, 120);
  const Eigen::Vector3d centre(0, 0, 80);
  const auto scene = test::makeScene(rig, test::sphere(centre, 30));
  const NormalMap normals = normalsFromDepth(scene.depth_mm, rig.left);
  for (int v = 30; v < 90; v += 10)
    for (int u = 50; u < 110; u += 10) {
      const Eigen::Vector3f p = liftPixel(rig.left, static_cast<float>(u), static_cast<float>(v),
                                          scene.depth_mm.at(u, v));
      const Eigen::Vector3f expected = (p - centre.cast<float>()).normalized();
      EXPECT_GT(normals.at(u, v).dot(expected), 0.999f);  // 2.5 degrees: the window is not a point
    }
}

TEST(NormalsFromDepth, KeepTwoSurfacesApart) {
  const RectifiedRig rig = test::endoscope(160, 120);
  Raster<float> depth(160, 120, 50.0f);  // a wall in front of another, a step of 20 %
  for (int v = 0; v < 120; ++v)
    for (int u = 80; u < 160; ++u) depth.at(u, v) = 60;
  const NormalMap normals = normalsFromDepth(depth, rig.left);
  for (int u = 70; u < 90; ++u)  // float rounding alone: no pixel of the other wall counts
    EXPECT_LT((normals.at(u, 60) - Eigen::Vector3f(0, 0, -1)).norm(), 1e-3f) << u;
}

TEST(NormalsFromDepth, AreAbsentWhereTooLittleIsMeasured) {
  const RectifiedRig rig = test::endoscope(160, 120);
  Raster<float> depth(160, 120, std::numeric_limits<float>::quiet_NaN());
  depth.at(80, 60) = 50;
  for (int u = 20; u < 120; ++u) depth.at(u, 30) = 50;  // one row makes no plane
  const NormalMap normals = normalsFromDepth(depth, rig.left);
  EXPECT_TRUE(normals.at(80, 60).hasNaN());
  EXPECT_TRUE(normals.at(60, 30).hasNaN());
}

TEST(PointCloud, HoldsMeasuredUnmaskedPixels) {
  const RectifiedRig rig = test::endoscope(160, 120);
  const auto scene = test::makeScene(rig, test::plane(60));
  const NormalMap normals = normalsFromDepth(scene.depth_mm, rig.left);
  const ColourImage colour(160, 120, Rgb8{10, 20, 30});
  Mask mask(160, 120, 0);
  for (int u = 0; u < 160; ++u) mask.at(u, 60) = 255;
  const PointCloud cloud = pointCloud(scene.depth_mm, normals, colour, rig.left, mask);
  ASSERT_EQ(cloud.points_mm.size(), 160u * 119u);
  EXPECT_EQ(cloud.normals.size(), cloud.points_mm.size());
  EXPECT_EQ(cloud.colours.front(), (Rgb8{10, 20, 30}));
  for (const auto& p : cloud.points_mm) EXPECT_NEAR(p.z(), 60, 1e-4);
}

}  // namespace
}  // namespace softscope
