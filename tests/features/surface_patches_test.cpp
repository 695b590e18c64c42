// tests/features/surface_patches_test.cpp: the same tissue from another distance, angle and turn.
#include "features/surface_patches.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace softscope {
namespace {

constexpr double kRadius_mm = 4;
constexpr int kSpacing_px = 3;

/// Grey value of the textured plane z = 0, x and y in mm: waves without a period in common.
double texture(double x, double y) {
  return 128 + 40 * std::sin(0.9 * x + 0.5 * std::sin(0.7 * y)) * std::cos(0.53 * y + 0.11 * x) +
         30 * std::sin(0.37 * x - 0.61 * y + std::sin(0.23 * x * y / 4)) +
         20 * std::cos(1.3 * y + 0.2 * x * x / 5);
}

/// What a camera at `world_from_camera` sees of the plane.
DepthImage imageOfPlane(const Eigen::Isometry3d& world_from_camera) {
  DepthImage image;
  image.camera = {160, 120, 140, 140, 80, 60};
  image.gray = GrayImage(160, 120);
  image.depth_mm = Raster<float>(160, 120);
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const Eigen::Vector3d ray = liftPixel<double>(image.camera, double(u), double(v), 1.0);
      const Eigen::Vector3d along = world_from_camera.linear() * ray;
      const double depth_mm = -world_from_camera.translation().z() / along.z();
      const Eigen::Vector3d at = world_from_camera.translation() + depth_mm * along;
      image.gray.at(u, v) = static_cast<std::uint8_t>(std::lround(texture(at.x(), at.y())));
      image.depth_mm.at(u, v) = static_cast<float>(depth_mm);
    }
  return image;
}

/// View of the plane from `distance_mm`, tilted from its normal and rotated about the axis.
Eigen::Isometry3d lookingDown(double distance_mm, double tilt_deg, double roll_deg) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(tilt_deg * M_PI / 180, Eigen::Vector3d::UnitX()));
  pose.translate(Eigen::Vector3d(0, 0, -distance_mm));
  pose.rotate(Eigen::AngleAxisd(roll_deg * M_PI / 180, Eigen::Vector3d::UnitZ()));
  return pose;
}

struct Count {
  int pairs = 0, right = 0;  // right: within a third of the radius on the plane
};

Count matched(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) {
  const auto a = surfacePatches(imageOfPlane(from), kRadius_mm, kSpacing_px);
  const auto b = surfacePatches(imageOfPlane(to), kRadius_mm, kSpacing_px);
  Count count;
  for (const auto& [i, k] : matchPatches(a, b, 0.9, kRadius_mm)) {
    const Eigen::Vector3d there = from * a[static_cast<std::size_t>(i)].centre_mm.cast<double>();
    const Eigen::Vector3d here = to * b[static_cast<std::size_t>(k)].centre_mm.cast<double>();
    ++count.pairs;
    count.right += (there - here).norm() < kRadius_mm / 3;
  }
  return count;
}

TEST(SurfacePatches, LieOnTheSurface) {
  const Eigen::Isometry3d pose = lookingDown(40, 20, 30);
  const auto patches = surfacePatches(imageOfPlane(pose), kRadius_mm, kSpacing_px);
  ASSERT_GT(patches.size(), 500u);
  for (const SurfacePatch& patch : patches)
    EXPECT_NEAR((pose * patch.centre_mm.cast<double>()).z(), 0, 1e-3);
}

TEST(SurfacePatches, MatchThemselves) {
  const Eigen::Isometry3d pose = lookingDown(40, 0, 0);
  const Count count = matched(pose, pose);
  EXPECT_GT(count.pairs, 500);
  EXPECT_EQ(count.right, count.pairs);
}

TEST(SurfacePatches, AreFoundFromAnotherDistanceAngleAndTurn) {
  const Eigen::Isometry3d from = lookingDown(40, 0, 0);
  for (const auto& [distance_mm, tilt_deg, roll_deg] : {std::tuple{40., 0., 90.},
                                                        {40., 0., 180.},
                                                        {55., 0., 0.},
                                                        {40., 35., 0.},
                                                        {50., 30., -70.}}) {
    const Count count = matched(from, lookingDown(distance_mm, tilt_deg, roll_deg));
    EXPECT_GT(count.pairs, 60) << distance_mm << " mm, " << tilt_deg << ", " << roll_deg;
    EXPECT_GT(count.right, 0.8 * count.pairs)
        << distance_mm << " mm, " << tilt_deg << ", " << roll_deg;
  }
}

TEST(SurfacePatches, AreLeftOutWithoutTextureDepthOrWhereIgnored) {
  DepthImage image = imageOfPlane(lookingDown(40, 0, 0));
  DepthImage flat = image;
  std::fill(flat.gray.values.begin(), flat.gray.values.end(), std::uint8_t{90});
  EXPECT_TRUE(surfacePatches(flat, kRadius_mm, kSpacing_px).empty());
  DepthImage without = image;
  std::fill(without.depth_mm.values.begin(), without.depth_mm.values.end(),
            std::numeric_limits<float>::quiet_NaN());
  EXPECT_TRUE(surfacePatches(without, kRadius_mm, kSpacing_px).empty());
  image.ignore = Mask(160, 120, 1);
  EXPECT_TRUE(surfacePatches(image, kRadius_mm, kSpacing_px).empty());
  EXPECT_TRUE(matchPatches({}, {}, 0.9, 1).empty());
}

}  // namespace
}  // namespace softscope
