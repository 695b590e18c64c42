// tests/simulation/scope_lens_test.cpp: a lens that bends, and pictures through it.
#include "eval/simulation/camera/scope_lens.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "eval/simulation/sequence/simulator.h"
#include "stereo/rectification/rectifier.h"

namespace softscope {
namespace {

SimulationOptions bentOptions() {
  SimulationOptions options;
  options.scope.width_px = 160;
  options.scope.height_px = 120;
  options.scope.k1 = -0.28;
  options.scope.k2 = 0.11;
  options.scope.p1 = 0.0012;
  options.scope.p2 = -0.0009;
  options.scope.k3 = -0.02;
  return options;
}

TEST(ScopeLens, RayIsTheInverseOfProject) {
  const ScopeLens lens = bentOptions().scope.lens();
  for (double v = -3; v < 123; v += 7)
    for (double u = -3; u < 163; u += 7) {
      const Eigen::Vector3d direction = lens.ray(u, v);
      EXPECT_EQ(direction.z(), 1);
      EXPECT_LT((lens.project(37 * direction) - Eigen::Vector2d(u, v)).norm(), 1e-9);
    }
}

TEST(ScopeLens, WithoutCoefficientsIsAPinhole) {
  const ScopeLens lens = ScopeOptions().lens();
  EXPECT_EQ(lens.ray(12, 34), liftPixel<double>(lens.camera, 12, 34, 1));
  EXPECT_TRUE(lens.invertible());
}

TEST(ScopeLens, ALensThatFoldsThePictureIsRefused) {
  SimulationOptions options = bentOptions();
  options.scope.k1 = -1.5;
  options.scope.k2 = 0;
  EXPECT_FALSE(options.scope.lens().invertible());
  EXPECT_THROW(options.validate(), OptionError);
}

// The inverse of OpenCV, in the rectification: no formula is shared with the lens.
TEST(ScopeLens, OpenCvTakesTheDistortionOffAgain) {
  const ScopeOptions scope = bentOptions().scope;
  const Rectifier rectifier(scope.calibration());
  const ScopeLens lens = scope.lens();
  for (int v = 2; v < 120; v += 13)
    for (int u = 2; u < 160; u += 13) {
      const Eigen::Vector2d straight =
          projectPoint<double>(rectifier.rig().left, 50 * lens.ray(u, v));
      EXPECT_LT((rectifier.rectifiedPixel(Eigen::Vector2d(u, v)) - straight).norm(), 1e-3);
    }
}

// Pixels, depth and tracks of the raw picture.
TEST(ScopeLens, TruthLiesOnTheBentPicture) {
  const SimulationOptions options = bentOptions();
  Simulator simulator(makeOrganMesh(options.organ, 1), options);
  const SimulatedFrame frame = simulator.frame(0, true);
  const ScopeLens lens = options.scope.lens();
  EXPECT_FALSE(simulator.calibration().rectified);
  ASSERT_GT(simulator.trackPoints().size(), 8u);
  for (std::size_t id = 0; id < simulator.trackPoints().size(); ++id) {
    const TrackPoint& point = simulator.trackPoints()[id];
    const Eigen::Vector2d seen = lens.project(frame.tracks_world_mm[id]);  // world = left at 0 s
    EXPECT_NEAR(seen.x(), point.u_px, 1e-3);
    EXPECT_NEAR(seen.y(), point.v_px, 1e-3);
    EXPECT_NEAR(frame.depth_mm.at(int(point.u_px), int(point.v_px)), frame.tracks_world_mm[id].z(),
                1e-3);
    EXPECT_TRUE(frame.tracks_visible[id]);
  }
}

}  // namespace
}  // namespace softscope
