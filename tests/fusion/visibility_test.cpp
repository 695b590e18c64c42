// tests/fusion/visibility_test.cpp: what the camera sees of a model, case by case.
#include "fusion/visibility.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "core/parallel.h"
#include "fusion/made_shots.h"

namespace softscope::test {
namespace {

const Eigen::Vector3f kTowards(0, 0, -1);

PointModel onePoint(const Eigen::Vector3f& position_mm, const Eigen::Vector3f& normal = kTowards) {
  PointModel model;
  model.add(position_mm, normal, {}, 1);
  return model;
}

Visibility see(const PointModel& model, const Shot& shot, const VisibilityOptions& options = {}) {
  return findVisible(model, shot.observation(), classifyPixels(shot.observation(), {}), options);
}

Sight sightOf(const Eigen::Vector3f& position_mm, const Shot& shot,
              const Eigen::Vector3f& normal = kTowards) {
  return see(onePoint(position_mm, normal), shot).points[0].sight;
}

TEST(Visibility, TellsEveryCaseApart) {
  Shot shot = takeShot(plane(55), smallCamera());
  shot.mask = Mask(96, 72);
  shot.mask.at(10, 10) = 1;
  shot.depth.depth_mm.at(20, 20) = kNoDepth;
  const auto at = [&](int u, int v, float z) {
    return liftPixel(shot.left, static_cast<float>(u), static_cast<float>(v), z);
  };
  EXPECT_EQ(sightOf(at(50, 40, 55), shot), Sight::kSeen);
  EXPECT_EQ(sightOf(at(50, 40, 56.9f), shot), Sight::kSeen);  // epsilon_d is 2 mm
  EXPECT_EQ(sightOf(at(50, 40, 57.1f), shot), Sight::kHidden);
  EXPECT_EQ(sightOf(at(50, 40, 53.1f), shot), Sight::kSeen);
  EXPECT_EQ(sightOf(at(50, 40, 52.9f), shot), Sight::kSeenThrough);
  EXPECT_EQ(sightOf(at(50, 40, 55), shot, {0, 0, 1}), Sight::kTurned);
  EXPECT_EQ(sightOf(at(10, 10, 55), shot), Sight::kMasked);
  EXPECT_EQ(sightOf(at(20, 20, 55), shot), Sight::kUnknown);
  EXPECT_EQ(sightOf(at(96, 40, 55), shot), Sight::kOutside);
  EXPECT_EQ(sightOf(at(50, 40, -55), shot), Sight::kOutside);
}

TEST(Visibility, DrawsTheLineAtTheNormalsAngle) {
  const Shot shot = takeShot(plane(55), smallCamera());
  const auto tilted = [](double degrees) {
    const float a = static_cast<float>(degrees * M_PI / 180);
    return Eigen::Vector3f(std::sin(a), 0, -std::cos(a));
  };
  EXPECT_EQ(sightOf({0, 0, 55}, shot, tilted(59)), Sight::kSeen);  // epsilon_n is 60 degrees
  EXPECT_EQ(sightOf({0, 0, 55}, shot, tilted(61)), Sight::kTurned);
}

// The pixel's depth is that of its centre: on a slope of 1, half a pixel off is 0.05 mm. The plane
// through the pixel gives the point's own depth, up to single precision at 55 mm (4e-6 mm each).
TEST(Visibility, MeasuresAlongThePointsOwnRay) {
  const Surface slope = plane(55, 1.0, -0.3);
  const Shot shot = takeShot(slope, smallCamera());
  for (double u = 20; u < 70; u += 1.37)
    for (double v = 20; v < 50; v += 1.71) {
      const double z = trueDepth(slope, shot.left, shot.world_from_left, u, v);
      const Eigen::Vector3d p = liftPixel(shot.left, u, v, z - 0.25);
      const PointSight seen =
          see(onePoint(p.cast<float>(), {0.69f, -0.2f, -0.69f}), shot).points[0];
      ASSERT_EQ(seen.sight, Sight::kSeen);
      EXPECT_NEAR(seen.ahead_mm, 0.25 * p.norm() / p.z(), 1e-3);
    }
}

TEST(Visibility, HidesWhatLiesBehindTheModelsOwnNearerSurface) {
  const Shot shot = takeShot(plane(55), smallCamera());
  PointModel model = onePoint({0, 0, 56.5f});
  EXPECT_EQ(see(model, shot).points[0].sight, Sight::kSeen);  // within epsilon_d of the measurement
  model.add({0.02f, 0, 55}, kTowards, {}, 1);
  EXPECT_EQ(see(model, shot).points[0].sight, Sight::kHidden);
  EXPECT_EQ(see(model, shot).points[1].sight, Sight::kSeen);
  model.positions_mm[1].z() = 50;  // seen through: it isn't there, so it hides nothing
  EXPECT_EQ(see(model, shot).points[0].sight, Sight::kSeen);
}

// A slope of 2 puts 0.8 mm between the near and the far end of a 4-pixel square; that is not
// another surface.
TEST(Visibility, ASteepSurfaceDoesNotHideItself) {
  const Surface steep = plane(55, 2.0);
  const Shot shot = takeShot(steep, smallCamera());
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  ASSERT_GT(model.size(), 500u);
  for (const PointSight& point : see(model, shot).points) EXPECT_EQ(point.sight, Sight::kSeen);
}

TEST(Visibility, IsUnknownNextToDepthEdges) {
  Shot shot = takeShot(plane(55), smallCamera());
  for (int v = 0; v < 72; ++v)
    for (int u = 0; u < 48; ++u) shot.depth.depth_mm.at(u, v) = 45;
  const Raster<PixelState> states = classifyPixels(shot.observation(), {});
  for (int v = 0; v < 72; ++v)
    for (int u = 0; u < 96; ++u)
      EXPECT_EQ(states.at(u, v) == PixelState::kEdge, u >= 46 && u < 50);  // radius 2
}

TEST(Visibility, IsUnknownWhereDepthIsUncertainOrGrazing) {
  Shot shot = takeShot(plane(55), smallCamera());
  shot.depth.sigma_mm.at(1, 1) = 1.1f;
  shot.depth.sigma_mm.at(2, 2) = kNoDepth;
  shot.depth.sigma_mm.at(3, 3) = 0;
  shot.normals.at(4, 4) = Eigen::Vector3f::Constant(kNoDepth);
  shot.normals.at(5, 5) = Eigen::Vector3f(0.995f, 0, -0.1f);
  const Raster<PixelState> states = classifyPixels(shot.observation(), {});
  for (int i = 0; i < 7; ++i)
    EXPECT_EQ(states.at(i, i), i >= 1 && i <= 5 ? PixelState::kRejected : PixelState::kAccepted);
}

TEST(Visibility, SurvivesWhatIsNotANumberOrOutOfThisWorld) {
  const Shot shot = takeShot(plane(55), smallCamera());
  const float nan = kNoDepth, inf = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, inf, -inf, 3e38f, -3e38f}) {
    EXPECT_EQ(sightOf({bad, 0, 55}, shot), Sight::kOutside);
    EXPECT_NE(sightOf({0, 0, bad}, shot), Sight::kSeen);
  }
  EXPECT_EQ(sightOf({0, 0, 55}, shot, {nan, nan, nan}), Sight::kTurned);
  EXPECT_TRUE(see(PointModel{}, shot).seen().empty());
}

TEST(Visibility, IsTheSameForAnyNumberOfThreads) {
  Shot shot = takeShot(sphere({0, 0, 75}, 20), smallCamera(320, 240));
  PointModel model;
  InsertionMemory memory;
  update(shot, {}, &memory, &model);
  addNoise(1, &shot);
  const Visibility many = see(model, shot);
  const ThreadLimit one(1);
  const Visibility alone = see(model, shot);
  ASSERT_EQ(many.points.size(), alone.points.size());
  for (std::size_t i = 0; i < many.points.size(); ++i) {
    EXPECT_EQ(many.points[i].sight, alone.points[i].sight);
    EXPECT_EQ(many.points[i].pixel, alone.points[i].pixel);
  }
}

TEST(Visibility, RefusesRastersThatDoNotFit) {
  const Shot shot = takeShot(plane(55), smallCamera());
  const Raster<PixelState> states(5, 5);
  EXPECT_THROW(findVisible({}, shot.observation(), states, {}), OptionError);
  Shot bad = shot;
  bad.normals = NormalMap(10, 10, Eigen::Vector3f::Zero());
  EXPECT_THROW(classifyPixels(bad.observation(), {}), OptionError);
  bad = shot;
  bad.world_from_left.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(classifyPixels(bad.observation(), {}), OptionError);
}

}  // namespace
}  // namespace softscope::test
