// tests/eval/alignment_test.cpp: rigid motions that were put in must come out.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "eval/alignment/rigid_alignment.h"
#include "eval/made_shapes.h"
#include "eval/surfaces/surface_alignment.h"

namespace softscope {
namespace {

Eigen::Isometry3d motion(double angle_rad, const Eigen::Vector3d& axis,
                         const Eigen::Vector3d& shift_mm) {
  return Eigen::Translation3d(shift_mm) * Eigen::AngleAxisd(angle_rad, axis.normalized());
}

std::vector<Eigen::Vector3d> somePoints(int count) {
  std::mt19937 random(1);
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3f& p : pointsInCube(count, 40, random))
    points.push_back(p.cast<double>());
  return points;
}

std::vector<Eigen::Vector3d> moved(const Eigen::Isometry3d& by,
                                   std::vector<Eigen::Vector3d> points) {
  for (Eigen::Vector3d& p : points) p = by * p;
  return points;
}

/// A box's surface, sampled; no face like another, so that every motion shows.
struct BoxScene {
  TriangleTree surface{makeBox({-20, -15, -10}, {20, 15, 10})};
  std::vector<Eigen::Vector3f> points_mm;
  BoxScene() {
    std::mt19937 random(2);
    points_mm = pointsNear(makeBox({-20, -15, -10}, {20, 15, 10}), 2000, 0, random);
  }
};

// Points are floats near 20 mm: each is off the surface by up to 1e-6 mm, the mean of 2000 by
// less.
constexpr double kFloatPoints_mm = 1e-6;

AlignmentOptions precise(AlignmentMetric metric) {
  AlignmentOptions options;
  options.metric = metric;
  options.max_iterations = 500;
  options.trimmed_share = 0;
  options.converged_step_mm = 1e-9;
  return options;
}

TEST(RigidFit, FindsAMotionThatWasPutIn) {
  const Eigen::Isometry3d truth = motion(2.2, {1, -2, 0.5}, {30, -20, 100});
  const RigidFit fit = fitRigid(somePoints(20), moved(truth, somePoints(20)));
  EXPECT_TRUE(fit.target_from_source.isApprox(truth, 1e-12));  // double, well conditioned
  EXPECT_NEAR(fit.rmse_mm, 0, 1e-12);
  EXPECT_TRUE(fit.unique);
}

TEST(RigidFit, IsTheLeastSquaresOfPairsThatDisagree) {
  // Four corners of a square, targets pushed outwards by 10 %: no rigid motion helps.
  const std::vector<Eigen::Vector3d> square = {
      {10, 10, 0}, {-10, 10, 0}, {-10, -10, 0}, {10, -10, 0}};
  std::vector<Eigen::Vector3d> larger = square;
  for (Eigen::Vector3d& p : larger) p *= 1.1;
  const RigidFit fit = fitRigid(square, larger);
  EXPECT_TRUE(fit.target_from_source.isApprox(Eigen::Isometry3d::Identity(), 1e-12));
  EXPECT_NEAR(fit.rmse_mm, std::sqrt(2.0), 1e-12);
}

TEST(RigidFit, NeverReflects) {
  std::vector<Eigen::Vector3d> mirrored = somePoints(20);
  for (Eigen::Vector3d& p : mirrored) p.x() = -p.x();
  const RigidFit fit = fitRigid(somePoints(20), mirrored);
  EXPECT_NEAR(fit.target_from_source.linear().determinant(), 1, 1e-12);
  EXPECT_GT(fit.rmse_mm, 1);
}

TEST(RigidFit, SaysWhenPointsLieOnOneLine) {
  const std::vector<Eigen::Vector3d> line = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {5, 10, 15}};
  EXPECT_FALSE(fitRigid(line, line).unique);
  const std::vector<Eigen::Vector3d> plane = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  EXPECT_TRUE(fitRigid(plane, plane).unique);
}

TEST(RigidFit, RefusesTooFewUnequalOrUnmeasuredPairs) {
  EXPECT_THROW(fitRigid(somePoints(2), somePoints(2)), InputError);
  EXPECT_THROW(fitRigid(somePoints(5), somePoints(4)), InputError);
  std::vector<Eigen::Vector3d> broken = somePoints(5);
  broken[3].z() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(fitRigid(broken, somePoints(5)), InputError);
}

TEST(SurfaceErrors, OfAShiftedPlaneAreTheShift) {
  const TriangleTree plane(makeRectangle(20, 20, 8, 8));
  std::vector<Eigen::Vector3f> points;
  for (int i = 1; i < 20; ++i)
    for (int j = 1; j < 20; ++j) points.emplace_back(i, j, -0.25f);
  points.emplace_back(-3, 10, 4);  // beyond the border: 5 mm away, on no side
  const SurfaceErrors e = surfaceErrors(plane.closestPoints(points));
  EXPECT_EQ(e.border_count, 1u);
  EXPECT_EQ(e.distance_mm.max, 5);
  EXPECT_NEAR(e.distance_mm.median, 0.25, 1e-12);
  EXPECT_EQ(e.signed_mm.nan_count, 1u);
  EXPECT_NEAR(e.signed_mm.mean, -0.25, 1e-12);
  EXPECT_NEAR(e.signed_mm.sd, 0, 1e-12);
}

TEST(SurfaceErrors, OfConcentricSpheresAreTheGap) {
  // The polyhedron of a sphere is inside it by at most 1 - cos of half its widest facet.
  const double sagitta_mm = 30 * (1 - std::cos(3.1416 / 200)) * 2;
  const TriangleTree sphere(makeSphere(200, 100, 30));
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3d& p : somePoints(1000))
    points.push_back((p.normalized() * 28.5).cast<float>());
  const SurfaceErrors e = surfaceErrors(sphere.closestPoints(points));
  EXPECT_GT(e.signed_mm.min, -1.5 - 1e-5);
  EXPECT_LT(e.signed_mm.max, -1.5 + sagitta_mm);
  EXPECT_EQ(e.signed_mm.nan_count, 0u);
}

class EveryMetric : public testing::TestWithParam<AlignmentMetric> {};
INSTANTIATE_TEST_SUITE_P(Metrics, EveryMetric,
                         testing::Values(AlignmentMetric::kPointToPlane,
                                         AlignmentMetric::kPointToPoint));

TEST_P(EveryMetric, BringsABoxBack) {
  const BoxScene scene;
  const Eigen::Isometry3d displaced = motion(0.05, {1, 2, 3}, {0.5, -0.8, 0.3});
  const SurfaceAlignment found =
      alignToSurface(movePoints(displaced, scene.points_mm), scene.surface, precise(GetParam()));
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.free_directions, 0);
  EXPECT_GT(found.before.distance_mm.rmse, 0.3);
  EXPECT_LT(found.after.distance_mm.rmse, 2 * kFloatPoints_mm);
  const Eigen::Isometry3d residual = found.surface_from_points * displaced;
  EXPECT_LT(residual.translation().norm(), kFloatPoints_mm);
  EXPECT_LT((residual.linear() - Eigen::Matrix3d::Identity()).norm() * 20, 2 * kFloatPoints_mm);
}

TEST_P(EveryMetric, LetsATenthOfThePointsBeWrong) {
  const BoxScene scene;
  std::vector<Eigen::Vector3f> points = scene.points_mm;
  for (std::size_t i = 0; i < points.size(); i += 12) points[i] += Eigen::Vector3f(7, 7, 7);
  const Eigen::Isometry3d displaced = motion(0.03, {3, 1, -2}, {0.2, 0.3, -0.4});
  AlignmentOptions options = precise(GetParam());
  options.trimmed_share = 0.1;
  const SurfaceAlignment found =
      alignToSurface(movePoints(displaced, points), scene.surface, options);
  const Eigen::Isometry3d residual = found.surface_from_points * displaced;
  EXPECT_LT(residual.translation().norm(), 1e-5);  // the trimmed set is not balanced, hence looser
  EXPECT_NEAR(found.after.distance_mm.median, 0, 1e-5);
  EXPECT_GT(found.after.distance_mm.max, 1);  // wrong points stay in the report
}

TEST(SurfaceAlignment, MovesAlongAPlanesNormalAndNowhereElse) {
  const TriangleTree plane(makeRectangle(20, 20, 8, 8));
  std::vector<Eigen::Vector3f> points;
  for (int i = 4; i < 17; ++i)
    for (int j = 4; j < 17; ++j) points.emplace_back(i, j, 0.25f);
  const SurfaceAlignment found =
      alignToSurface(points, plane, precise(AlignmentMetric::kPointToPlane));
  EXPECT_TRUE(found.converged());
  EXPECT_EQ(found.free_directions, 3);
  EXPECT_NEAR(found.before.signed_mm.mean, 0.25, 1e-12);
  EXPECT_NEAR(found.after.distance_mm.max, 0, 1e-9);
  EXPECT_TRUE(found.surface_from_points.isApprox(motion(0, {0, 0, 1}, {0, 0, -0.25}), 1e-9));
}

TEST(SurfaceAlignment, CentresASphere) {
  const TriangleTree sphere(makeSphere(60, 31, 30));
  std::mt19937 random(3);
  const std::vector<Eigen::Vector3f> points = pointsNear(makeSphere(60, 31, 30), 3000, 0, random);
  const Eigen::Isometry3d displaced = motion(0, {0, 0, 1}, {0.4, -0.3, 0.2});
  const SurfaceAlignment found = alignToSurface(movePoints(displaced, points), sphere,
                                                precise(AlignmentMetric::kPointToPlane));
  EXPECT_TRUE(found.converged());
  EXPECT_LT((found.surface_from_points * displaced).translation().norm(), 1e-5);
  EXPECT_LT(found.after.distance_mm.rmse, 2 * kFloatPoints_mm);
}

TEST(SurfaceAlignment, StartsWhereItIsTold) {
  const BoxScene scene;
  const Eigen::Isometry3d displaced = motion(1.5, {0, 0, 1}, {100, 0, 0});
  const SurfaceAlignment found =
      alignToSurface(movePoints(displaced, scene.points_mm), scene.surface, {},
                     motion(0.02, {1, 0, 0}, {0.1, 0.2, 0}) * displaced.inverse());
  EXPECT_TRUE(found.converged());
  EXPECT_LT(found.before.distance_mm.max, 1);
  EXPECT_LT(found.after.distance_mm.max, 1e-3);  // ten times the default step
}

TEST(SurfaceAlignment, SaysWhenItRanOutOfStepsOrPairs) {
  const BoxScene scene;
  AlignmentOptions options = precise(AlignmentMetric::kPointToPoint);
  options.max_iterations = 1;
  const auto displaced = movePoints(motion(0.05, {1, 2, 3}, {1, 0, 0}), scene.points_mm);
  EXPECT_EQ(alignToSurface(displaced, scene.surface, options).stop, AlignmentStop::kIterationLimit);

  const TriangleTree patch(makeRectangle(1, 1, 1, 1));
  const SurfaceAlignment none = alignToSurface({{5, 5, 5}, {6, 6, 6}}, patch);
  EXPECT_EQ(none.stop, AlignmentStop::kTooFewPairs);
  EXPECT_TRUE(none.surface_from_points.isApprox(Eigen::Isometry3d::Identity()));
  EXPECT_EQ(alignToSurface({}, patch).stop, AlignmentStop::kTooFewPairs);
}

TEST(SurfaceAlignment, LeavesUnmeasuredPointsOut) {
  const BoxScene scene;
  std::vector<Eigen::Vector3f> points =
      movePoints(motion(0.02, {1, 1, 0}, {0.3, 0, 0.1}), scene.points_mm);
  points.insert(points.begin(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
  const SurfaceAlignment found = alignToSurface(points, scene.surface);
  EXPECT_EQ(found.after.distance_mm.nan_count, 1u);
  EXPECT_LT(found.after.distance_mm.max, 1e-3);
}

TEST(AlignmentOptions, AreChecked) {
  AlignmentOptions options;
  EXPECT_NO_THROW(options.validate());
  options.trimmed_share = 1;
  EXPECT_THROW(options.validate(), OptionError);
  options = {};
  options.max_iterations = 0;
  EXPECT_THROW(options.validate(), OptionError);
  options = {};
  options.converged_step_mm = 0;
  EXPECT_THROW(options.validate(), OptionError);
}

}  // namespace
}  // namespace softscope
