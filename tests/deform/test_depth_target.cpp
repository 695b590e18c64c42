// tests/deform/test_depth_target.cpp: which points the depth map pulls, and where to.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "deform/energy/surface_target.h"
#include "scenes.h"

namespace softscope {
namespace {

/// A plane at z = 50 mm, facing the scope; 41 x 31 pixels, 0.5 mm each.
struct PlaneView {
  PinholeCamera camera = scenes::makeCamera(41, 31, 100);
  DepthMap depth{Raster<float>(41, 31, 50.f), Raster<float>(41, 31, 0.1f)};
  NormalMap normals{41, 31, Eigen::Vector3f(0, 0, -1)};
  AssociationOptions options;
  Eigen::Isometry3d left_from_world = Eigen::Isometry3d::Identity();

  PlaneTarget ask(const Eigen::Vector3f& point, const Eigen::Vector3f& normal = {0, 0, -1}) const {
    PlaneTarget target;
    DepthTarget(depth, normals, camera, left_from_world, options)
        .lookUp(&point, &normal, 1, &target);
    return target;
  }
};

TEST(DepthTarget, GivesThePixelsPlane) {
  const PlaneTarget target = PlaneView().ask({1.02f, -2.04f, 50.7f});
  ASSERT_GT(target.reliability, 0);
  EXPECT_NEAR(target.point_mm.z(), 50, 1e-5);
  EXPECT_NEAR(target.point_mm.x(), 1.0, 0.26);  // the centre of a pixel of 0.5 mm
  EXPECT_EQ(target.normal, Eigen::Vector3f(0, 0, -1));
}

TEST(DepthTarget, KeepsToItsThresholds) {
  PlaneView view;
  view.options.max_distance_mm = 2;
  EXPECT_EQ(view.ask({0, 0, 52.1f}).reliability, 0);
  EXPECT_GT(view.ask({0, 0, 51.9f}).reliability, 0);
  EXPECT_EQ(view.ask({0, 0, 50}, Eigen::Vector3f(1, 0, -0.9f).normalized()).reliability, 0);
  EXPECT_GT(view.ask({0, 0, 50}, Eigen::Vector3f(1, 0, -1.1f).normalized()).reliability, 0);
  EXPECT_EQ(view.ask({0, 0, 50}, {0, 0, 1}).reliability, 0);  // the far side of something thin
}

TEST(DepthTarget, IsAbsentOutsideTheImageBehindTheScopeAndForNaN) {
  PlaneView view;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(view.ask({11, 0, 50}).reliability, 0);
  EXPECT_EQ(view.ask({0, -8, 50}).reliability, 0);
  EXPECT_EQ(view.ask({0, 0, -50}).reliability, 0);
  EXPECT_EQ(view.ask({0, 0, 0}).reliability, 0);
  EXPECT_EQ(view.ask({nan, 0, 50}).reliability, 0);
  EXPECT_EQ(view.ask({0, 0, 50}, {nan, 0, 0}).reliability, 0);
  view.depth.depth_mm.at(20, 15) = nan;
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 0);
  view.depth.depth_mm.at(20, 15) = 50;
  view.normals.at(20, 15).setConstant(nan);
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 0);
}

TEST(DepthTarget, WorksInTheWorldFrame) {
  PlaneView view;
  view.left_from_world = scenes::rigidMotion();
  const Eigen::Isometry3d world_from_left = view.left_from_world.inverse();
  const Eigen::Vector3d point = world_from_left * Eigen::Vector3d(1, 2, 50.5);
  const Eigen::Vector3d normal = world_from_left.linear() * Eigen::Vector3d(0, 0, -1);
  const PlaneTarget target = view.ask(point.cast<float>(), normal.cast<float>());
  ASSERT_GT(target.reliability, 0);
  const double distance = (point - target.point_mm.cast<double>()).dot(normal);
  EXPECT_NEAR(distance, -0.5, 1e-4);  // float coordinates of 60 mm
}

TEST(DepthTarget, WeighsByInverseVarianceWhereAskedTo) {
  PlaneView view;
  view.options.reference_sigma_mm = 0;
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 1);
  view.options.reference_sigma_mm = 0.15;
  EXPECT_NEAR(view.ask({0, 0, 50}).reliability, 2.25, 1e-4);  // (0.15 / 0.1)^2
  view.depth.sigma_mm.at(20, 15) = 0.3f;
  EXPECT_NEAR(view.ask({0, 0, 50}).reliability, 0.25, 1e-4);
  view.depth.sigma_mm.at(20, 15) = 1e-9f;
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 4);  // max_reliability
  view.depth.sigma_mm.at(20, 15) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 0);
  view.depth.sigma_mm = {};
  EXPECT_EQ(view.ask({0, 0, 50}).reliability, 1);
}

TEST(DepthTarget, RefusesMapsOfAnotherShape) {
  PlaneView view;
  view.normals = NormalMap(40, 31, Eigen::Vector3f::Zero());
  EXPECT_THROW(view.ask({0, 0, 50}), OptionError);
}

}  // namespace
}  // namespace softscope
