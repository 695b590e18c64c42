// tests/simulation/simulator_test.cpp: images, depth, mesh, tracks and path are consistent.
#include "eval/simulation/sequence/simulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel.h"
#include "simple_shapes.h"

namespace softscope {
namespace {

SimulationOptions smallOptions() {
  SimulationOptions options;
  options.scope.width_px = 120;
  options.scope.height_px = 90;
  options.organ.cells_per_side = 24;
  return options;
}

Simulator smallSimulator(const SimulationOptions& options) {
  return {makeOrganMesh(options.organ, 1), options};
}

/// The mean difference between the left picture and the right one, moved by the true disparity
/// and `offset_px` more.
double differenceAt(const SimulatedFrame& frame, const RectifiedRig& rig, double offset_px) {
  double sum = 0;
  int count = 0;
  const GrayImage left = toGray(frame.pictures.left), right = toGray(frame.pictures.right);
  for (int v = 0; v < left.height_px; ++v)
    for (int u = 0; u < left.width_px; ++u) {
      const double x = u - rig.disparityPx(frame.depth_mm.at(u, v)) + offset_px;
      if (!(x >= 0) || x >= right.width_px - 1) continue;  // NaN too
      const int i = static_cast<int>(x);
      const double seen = right.at(i, v) + (x - i) * (right.at(i + 1, v) - right.at(i, v));
      sum += std::abs(left.at(u, v) - seen);
      ++count;
    }
  return sum / count;
}

TEST(Simulator, MeasuresASphereAsTheFormulaSays) {
  SimulationOptions options = smallOptions();
  options.deformation.breathing.amplitude_mm = options.deformation.heartbeat.amplitude_mm =
      options.deformation.push.amplitude_mm = 0;
  options.camera.distance_mm = 40;
  Simulator simulator(test::makeSphere(20, 100), options);
  const SimulatedFrame frame = simulator.frame(0);
  const RectifiedRig& rig = simulator.rig();
  // The scope views the nearest point of the sphere with the middle of its baseline.
  const Eigen::Vector3d centre(0.5 * rig.baseline_mm, 0, 60);
  for (int v = 5; v < 90; v += 5)
    for (int u = 5; u < 120; u += 5) {
      const Eigen::Vector3d ray = liftPixel<double>(rig.left, double(u), double(v), 1.0);
      const double a = ray.squaredNorm(), b = ray.dot(centre), c = centre.squaredNorm() - 400;
      const double inside = b * b - a * c;
      if (inside < 0.3 * b * b * 0.05) continue;  // near the silhouette depth is ill-conditioned
      // Triangles of 0.31 mm lie 0.0012 mm below the sphere, seen aslant three times that.
      EXPECT_NEAR(frame.depth_mm.at(u, v), (b - std::sqrt(inside)) / a, 0.005);
    }
}

TEST(Simulator, ShowsTheRightCameraWhatTheDisparityPromises) {
  SimulationOptions options = smallOptions();
  options.scope.width_px = 240;
  options.scope.height_px = 180;
  options.texture.wetness = 0;  // highlights move with the eye,
  options.sensor.vignetting = options.sensor.noise = options.sensor.shot_noise = 0;
  Simulator simulator = smallSimulator(options);
  for (const int index : {0, 13}) {
    const SimulatedFrame frame = simulator.frame(index);
    const double exact = differenceAt(frame, simulator.rig(), 0);
    EXPECT_LT(exact, 3);  // grey levels: interpolation at 240 px, and hidden places
    // A fifth of a pixel off on either side is worse: the truth is right to better than that.
    EXPECT_GT(differenceAt(frame, simulator.rig(), 0.2), exact);
    EXPECT_GT(differenceAt(frame, simulator.rig(), -0.2), exact);
  }
}

TEST(Simulator, TracksStayOnTheirTissueAndStartAtTheirPixels) {
  Simulator simulator = smallSimulator(smallOptions());
  ASSERT_GT(simulator.trackPoints().size(), 8u);
  const SimulatedFrame first = simulator.frame(0), later = simulator.frame(20);
  for (std::size_t id = 0; id < simulator.trackPoints().size(); ++id) {
    const TrackPoint& point = simulator.trackPoints()[id];
    const Eigen::Vector2d seen = projectPoint(simulator.rig().left, first.tracks_world_mm[id]);
    EXPECT_NEAR(seen.x(), point.u_px, 0.005);  // float barycentrics: 1e-5 of a 1 mm edge
    EXPECT_NEAR(seen.y(), point.v_px, 0.005);
    EXPECT_NEAR(first.depth_mm.at(point.u_px, point.v_px), first.tracks_world_mm[id].z(), 1e-3);
    EXPECT_EQ(later.tracks_world_mm[id],
              positionOf(point, later.vertices_world_mm, simulator.triangles()));
  }
  EXPECT_GT((later.tracks_world_mm[0] - first.tracks_world_mm[0]).norm(), 0.1);  // it did move
}

/// Share of the tracked points, after a quarter of the period of the scope's path.
double outOfViewAtTheTurn(const SimulationOptions& options) {
  const double quarter_s = options.camera.period_s / 4;
  Simulator simulator = smallSimulator(options);
  const std::vector<bool> visible =
      simulator.frame(int(quarter_s * options.frames_per_second)).tracks_visible;
  return double(std::count(visible.begin(), visible.end(), false)) / double(visible.size());
}

TEST(Simulator, OnlyPointsNearTheBorderOfTheFirstImageLeaveTheView) {
  SimulationOptions options = smallOptions();
  options.organ.lobe_mm = options.organ.fold_mm = 0;  // no rim within the view
  options.camera.amplitude_mm = 12;
  options.track_spacing_px = 6;
  EXPECT_EQ(outOfViewAtTheTurn(options), 0);
  options.track_border = 0.02;
  EXPECT_GT(outOfViewAtTheTurn(options), 0.03);
}

TEST(Simulator, DepthAgreesWithTheMeshSeenFromTheTrajectory) {
  SimulationOptions options = smallOptions();
  options.camera.path = "orbit";
  Simulator simulator = smallSimulator(options);
  const SimulatedFrame frame = simulator.frame(17);
  EXPECT_GT(frame.pose.world_from_left.translation().norm(), 1.0);
  const RayTree tree(frame.vertices_world_mm, simulator.triangles());
  const Eigen::Vector3f eye = frame.pose.world_from_left.translation().cast<float>();
  for (int v = 2; v < 90; v += 11)
    for (int u = 2; u < 120; u += 11) {
      const Eigen::Vector3d ray =
          liftPixel<double>(simulator.rig().left, double(u), double(v), 1.0);
      const RayHit hit = tree.cast(eye, (frame.pose.world_from_left.linear() * ray).cast<float>());
      ASSERT_EQ(hit.met(), std::isfinite(frame.depth_mm.at(u, v)));
      // Two frames of reference, each rounded to float at 60 mm (4e-6 mm), seen aslant.
      if (hit.met()) {
        EXPECT_NEAR(hit.distance, frame.depth_mm.at(u, v), 1e-3);
      }
    }
}

TEST(Simulator, GivesTheSameBytesOnAnyNumberOfThreadsAndInAnyOrder) {
  const SimulationOptions options = smallOptions();
  const auto framesOn = [&](int threads, std::vector<int> order) {
    const ThreadLimit limit(threads);
    Simulator simulator = smallSimulator(options);
    SimulatedFrame last;
    for (const int index : order) last = simulator.frame(index);
    return last;
  };
  const SimulatedFrame one = framesOn(1, {0, 1, 2}), many = framesOn(0, {2});
  EXPECT_EQ(one.pictures.left.values, many.pictures.left.values);
  EXPECT_EQ(one.pictures.right.values, many.pictures.right.values);
  EXPECT_EQ(one.vertices_world_mm, many.vertices_world_mm);
  EXPECT_EQ(one.tracks_world_mm, many.tracks_world_mm);
}

TEST(Simulator, AnotherSeedMakesAnotherSequence) {
  SimulationOptions options = smallOptions();
  const SimulatedFrame first = smallSimulator(options).frame(3);
  options.seed = 2;
  EXPECT_NE(first.pictures.left.values, smallSimulator(options).frame(3).pictures.left.values);
}

TEST(Simulator, LooksLikeTissueAndNotLikeAWall) {
  SimulationOptions options = smallOptions();
  const SimulatedFrame frame = smallSimulator(options).frame(0);
  double red = 0, green = 0, blue = 0, gradient = 0;
  const GrayImage gray = toGray(frame.pictures.left);
  for (int v = 20; v < 70; ++v)
    for (int u = 30; u < 90; ++u) {
      const Rgb8& pixel = frame.pictures.left.at(u, v);
      red += pixel.red / 3000.0;
      green += pixel.green / 3000.0;
      blue += pixel.blue / 3000.0;
      gradient += std::abs(gray.at(u + 1, v) - gray.at(u, v)) / 3000.0;
    }
  EXPECT_GT(red, 1.25 * green);  // reddish,
  EXPECT_GT(red, 110);           // well lit,
  EXPECT_LT(red, 235);           // not blown out,
  EXPECT_GT(gradient, 3);        // and there is something to match
  EXPECT_GT(green, blue);
}

TEST(Simulator, StillScopesStandStillAndOthersStartAtTheOrigin) {
  SimulationOptions options = smallOptions();
  for (const char* path : {"still", "sweep", "orbit"}) {
    options.camera.path = path;
    options.camera.tremor_mm = 0;
    Simulator simulator = smallSimulator(options);
    EXPECT_TRUE(simulator.frame(0).pose.world_from_left.matrix().isIdentity(0));
    const double way_mm = simulator.frame(30).pose.world_from_left.translation().norm();
    if (options.camera.path == "still") {
      EXPECT_LT(way_mm, 1e-9);  // rounding of double
    } else {
      EXPECT_GT(way_mm, 2.0);  // a fifth of the period: 0.95 of 4 mm
    }
  }
}

TEST(Simulator, RefusesWhatItCannotSimulate) {
  SimulationOptions options = smallOptions();
  EXPECT_THROW(Simulator({}, options), Error);
  options.camera.path = "zigzag";
  EXPECT_THROW(smallSimulator(options), OptionError);
  options = smallOptions();
  options.scope.baseline_mm = 0;
  EXPECT_THROW(smallSimulator(options), OptionError);
  options = smallOptions();
  TriangleMesh gap = test::makeSquare(50);  // nothing in the middle of the box
  gap.triangles = {{0, 1, 4}};
  gap.vertices_mm.push_back({0, -20, 0});
  EXPECT_THROW(Simulator(gap, options), InputError);
}

}  // namespace
}  // namespace softscope
