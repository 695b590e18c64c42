// tests/eval/model_drawing_test.cpp: models whose view is known exactly.
#include "eval/images/model_drawing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace softscope {
namespace {

const PinholeCamera kCamera{160, 120, 200, 200, 79.5, 59.5};

/// z = 50 + 0.2 x, a point every 0.3 mm; grey rises by 4 per mm to the right.
PointModel slope(double spacing_mm = 0.3, double half_mm = 12) {
  PointModel model;
  const Eigen::Vector3f normal = Eigen::Vector3f(0.2f, 0, -1).normalized();
  for (double y = -half_mm; y <= half_mm; y += spacing_mm)
    for (double x = -half_mm; x <= half_mm; x += spacing_mm) {
      const auto grey = static_cast<std::uint8_t>(std::lround(120 + 4 * x));
      model.add({float(x), float(y), float(50 + 0.2 * x)}, normal, {grey, grey, 30}, 1);
    }
  return model;
}

/// Depth of the slope along the ray of a pixel, mm.
double slopeDepth(int u) { return 50 / (1 - 0.2 * (u - kCamera.cx_px) / kCamera.fx_px); }

TEST(ModelDrawing, APlaneHasItsExactDepthAndColourAtEveryPixel) {
  const ModelDrawing drawn = drawModel(slope(), kCamera, Eigen::Isometry3d::Identity());
  int pixels = 0;
  for (int v = 15; v < 105; ++v)
    for (int u = 40; u < 120; ++u, ++pixels) {
      const double z_mm = slopeDepth(u), x_mm = z_mm * (u - kCamera.cx_px) / kCamera.fx_px;
      ASSERT_NEAR(drawn.depth_mm.at(u, v), z_mm, 1e-4) << u << " " << v << ": one plane, no error";
      ASSERT_NEAR(drawn.colour.at(u, v).red, 120 + 4 * x_mm, 1.1) << "rounded twice";
      ASSERT_EQ(drawn.colour.at(u, v).blue, 30);
    }
  EXPECT_EQ(pixels, 90 * 80);
}

TEST(ModelDrawing, APlaneEndsWhereItsPointsEnd) {
  const ModelDrawing drawn = drawModel(slope(), kCamera, Eigen::Isometry3d::Identity());
  // The lowest points lie at y = -12 mm; discs of 1.5 spacings reach 0.45 mm farther.
  for (int v = 0; v < 60; ++v) {
    const double y_mm = (v - kCamera.cy_px) / kCamera.fy_px * slopeDepth(80);
    if (y_mm > -12.5 && y_mm < -12) continue;  // the rim of a disc
    EXPECT_EQ(std::isnan(drawn.depth_mm.at(80, v)), y_mm < -12) << v;
  }
}

TEST(ModelDrawing, ASphereHasItsFrontAlone) {
  PointModel model;  // radius 10 mm at 60 mm; spread evenly by the golden angle
  constexpr int kPoints = 20000;
  for (int i = 0; i < kPoints; ++i) {
    const double z = 1 - 2 * (i + 0.5) / kPoints, r = std::sqrt(1 - z * z);
    const double angle = i * M_PI * (3 - std::sqrt(5.0));
    const Eigen::Vector3f way(float(r * std::cos(angle)), float(r * std::sin(angle)), float(z));
    model.add(Eigen::Vector3f(0, 0, 60) + 10 * way, way, {200, 100, 90}, 1);
  }
  const ModelDrawing drawn = drawModel(model, kCamera, Eigen::Isometry3d::Identity());
  double worst_mm = 0;
  int inside = 0;
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const Eigen::Vector3d ray = liftPixel<double>(kCamera, u, v, 1);
      // |t ray - c| = 10: a t^2 - 2 b t + c = 0.
      const double a = ray.squaredNorm(), b = 60, c = 3600 - 100, root = b * b - a * c;
      if (std::abs(root) < 25) continue;  // the rim: a ray that meets at over 60 degrees
      ASSERT_EQ(std::isnan(drawn.depth_mm.at(u, v)), root < 0) << u << " " << v;
      if (root < 0) continue;
      ++inside;
      worst_mm = std::max(worst_mm, std::abs(drawn.depth_mm.at(u, v) - (b - std::sqrt(root)) / a));
    }
  EXPECT_GT(inside, 2500);
  // A disc of radius r is r^2 / (2 * 10 mm) in front of the sphere at most: here
  // r is 0.36 mm, and the ray meets the rim of the disc at up to 60 degrees.
  EXPECT_LT(worst_mm, 0.02);
}

TEST(ModelDrawing, TheNearerSurfaceHidesTheOther) {
  PointModel model = slope();
  const std::size_t far = model.size();
  for (std::size_t i = 0; i < far; ++i)
    model.add(model.positions_mm[i] + Eigen::Vector3f(0, 0, 5), model.normals[i], {0, 0, 255}, 1);
  const ModelDrawing both = drawModel(model, kCamera, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(both.depth_mm.at(80, 60), slopeDepth(80), 1e-4);
  EXPECT_EQ(both.colour.at(80, 60).blue, 30) << "nothing of the far one shines through";
}

TEST(ModelDrawing, GapsStayGaps) {
  const PointModel whole = slope();
  PointModel model;
  for (const Eigen::Vector3f& p : whole.positions_mm)
    if (p.head<2>().norm() > 2)  // a hole of 4 mm
      model.add(p, Eigen::Vector3f(0.2f, 0, -1).normalized(), {9, 9, 9}, 1);
  const ModelDrawing drawn = drawModel(model, kCamera, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(std::isnan(drawn.depth_mm.at(80, 60)));
  EXPECT_EQ(drawn.colour.at(80, 60), (Rgb8{0, 0, 0}));
}

TEST(ModelDrawing, TheRadiusFollowsTheSpacing) {
  EXPECT_NEAR(nearestNeighbourMm(slope(0.3)), 0.3, 1e-3);
  EXPECT_NEAR(nearestNeighbourMm(slope(1.0)), 1.0, 1e-3);
  EXPECT_EQ(nearestNeighbourMm(PointModel()), 0);
  const ModelDrawing coarse = drawModel(slope(1.0), kCamera, Eigen::Isometry3d::Identity());
  for (int v = 15; v < 105; ++v)
    for (int u = 40; u < 120; ++u) ASSERT_FALSE(std::isnan(coarse.depth_mm.at(u, v)));
}

TEST(ModelDrawing, TheCameraIsWhereItsPoseSays) {
  Eigen::Isometry3d world_from_left = Eigen::Isometry3d::Identity();
  world_from_left.translation() = Eigen::Vector3d(0, 1, 10);
  const ModelDrawing drawn = drawModel(slope(), kCamera, world_from_left);
  EXPECT_NEAR(drawn.depth_mm.at(80, 60), slopeDepth(80) * 0.8, 1e-3) << "10 mm nearer";
}

TEST(ModelDrawing, PointsThatCannotBeSeenAreLeftOut) {
  PointModel model;
  model.add({0, 0, 50}, {0, 0, 1}, {9, 9, 9}, 1);               // turned away
  model.add({0, 0, -50}, {0, 0, -1}, {9, 9, 9}, 1);             // behind the camera
  model.add({std::nanf(""), 0, 50}, {0, 0, -1}, {9, 9, 9}, 1);  // nowhere
  for (const float depth : drawModel(model, kCamera, Eigen::Isometry3d::Identity()).depth_mm.values)
    ASSERT_TRUE(std::isnan(depth));
  model.add({0, 0, 50}, {0, 0, 0}, {9, 9, 9}, 1);  // without normal: a dot of a pixel
  const ModelDrawing dot = drawModel(model, kCamera, Eigen::Isometry3d::Identity());
  EXPECT_NEAR(dot.depth_mm.at(79, 59), 50, 1e-3);
  EXPECT_TRUE(std::isnan(dot.depth_mm.at(82, 60)));
}

}  // namespace
}  // namespace softscope
