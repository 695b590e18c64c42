// tests/eval/model_errors_test.cpp: planes before a camera, where every number is known.
#include "eval/surfaces/model_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "eval/distance/point_tree.h"
#include "eval/made_shapes.h"
#include "eval/surfaces/error_pool.h"

namespace softscope {
namespace {

constexpr float kNoPlace = std::numeric_limits<float>::quiet_NaN();

/// 80 x 64 pixels, f 100 px, baseline 5 mm: at 50 mm a pixel is half a millimetre, the
/// disparity 10.
RectifiedRig smallRig() {
  RectifiedRig rig;
  rig.left = {80, 64, 100, 100, 39.5, 31.5};
  rig.baseline_mm = 5;
  return rig;
}

/// A rectangle at z = 50 mm that overfills the picture by far, facing the camera.
TriangleMesh wall() {
  TriangleMesh mesh = makeRectangle(400, 400, 4, 4);
  for (Eigen::Vector3f& v : mesh.vertices_mm) v += Eigen::Vector3f(-200, -200, 50);
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Points of the wall on a grid of half a millimetre, `off_mm` nearer to the camera.
std::vector<Eigen::Vector3f> wallPoints(float from_x_mm, float to_x_mm, float off_mm) {
  std::vector<Eigen::Vector3f> points;
  for (float y = -20; y <= 20; y += 0.5f)
    for (float x = from_x_mm; x <= to_x_mm; x += 0.5f) points.emplace_back(x, y, 50 - off_mm);
  return points;
}

struct Moment {
  RectifiedRig rig = smallRig();
  Raster<float> depth_mm = Raster<float>(80, 64, 50.0f);
  TriangleTree surface{wall()};
  TrueMoment truth() const { return {surface, depth_mm, rig, Eigen::Isometry3d::Identity()}; }
};

TEST(ModelErrors, AShiftedWallIsOffByTheShiftAndOutside) {
  const Moment moment;
  const ModelErrors errors = modelErrors(wallPoints(-25, 25, 0.25f), moment.truth());
  EXPECT_NEAR(errors.distance_mm.mean, 0.25, 1e-9);
  EXPECT_NEAR(errors.signed_mm.mean, 0.25, 1e-9) << "towards the camera is outside";
  EXPECT_NEAR(errors.distance_mm.p95, 0.25, 1e-9);
  EXPECT_EQ(errors.border_count, 0u);
  EXPECT_NEAR(errors.both.share, 1, 0);
  // The grid of pixels and that of points are half a millimetre apart at most, each way a quarter.
  EXPECT_LT(errors.both.distance_mm.max, std::sqrt(0.25 * 0.25 * 3) + 1e-5);
  EXPECT_NEAR(errors.hausdorff.hd95_max_of_directed_mm, errors.both.distance_mm.p95, 1e-12);
}

TEST(ModelErrors, SplitsWhatTheCameraSeesFromWhatItDoesNot) {
  const Moment moment;
  // The picture shows x from -20 to 20 mm (80 px of 0.5 mm) and y from -16 to 16.
  std::vector<Eigen::Vector3f> points{{0, 0, 50}, {19, 15, 50.5f}, {30, 0, 51}, {0, 18, 49}};
  const ModelErrors errors = modelErrors(points, moment.truth());
  EXPECT_EQ(errors.each_observed, (std::vector<std::uint8_t>{1, 1, 0, 0}));
  EXPECT_NEAR(errors.observed_share, 0.5, 0);
  EXPECT_NEAR(errors.observed_mm.mean, 0.25, 1e-6);
  EXPECT_NEAR(errors.predicted_mm.mean, 1, 1e-6);
}

TEST(ModelErrors, APointFarBehindItsTissueIsStillObserved) {
  const Moment moment;
  const ModelErrors errors = modelErrors({{0, 0, 60}}, moment.truth());
  EXPECT_EQ(errors.each_observed[0], 1) << "else large errors would leave the observed part";
  EXPECT_NEAR(errors.observed_mm.mean, 10, 1e-5);
  EXPECT_NEAR(errors.observed_signed_mm.mean, -10, 1e-5);
}

TEST(ModelErrors, BeyondTheRimOfAnOpenTruthNothingIsJudged) {
  Moment moment;
  TriangleMesh patch = makeRectangle(20, 20, 4, 4);
  for (Eigen::Vector3f& v : patch.vertices_mm) v += Eigen::Vector3f(-10, -10, 50);
  moment.surface = TriangleTree(patch);
  // Over the middle, right over the rim, and 4 mm beside it, all in the picture.
  const ModelErrors errors =
      modelErrors({{0, 0, 49.5f}, {10, 0, 49.5f}, {14, 0, 49.5f}}, moment.truth());
  EXPECT_EQ(errors.each_observed, (std::vector<std::uint8_t>{1, 1, 0}));
  EXPECT_EQ(errors.beyond_count, 1u);
  EXPECT_NEAR(errors.observed_mm.max, 0.5, 1e-6);
  EXPECT_EQ(errors.predicted_mm.count, 0u);
}

TEST(ModelErrors, TissueBehindSomethingIsPredicted) {
  Moment moment;
  for (int v = 0; v < 64; ++v)
    for (int u = 0; u < 40; ++u) moment.depth_mm.at(u, v) = 30;  // an obstacle on the left
  const ModelErrors errors = modelErrors({{-10, 0, 50}, {10, 0, 50}}, moment.truth());
  EXPECT_EQ(errors.each_observed, (std::vector<std::uint8_t>{0, 1}));
}

TEST(ModelErrors, HalfAModelHasHalfOfTheTissue) {
  const Moment moment;
  const ModelErrors errors = modelErrors(wallPoints(-30, -0.25f, 0), moment.truth());
  // Tissue in both pictures: u from 18 to 71 in steps of 4 (20 … 68: 13 columns). Points reach
  // x = -0.5; a sample counts within 1 mm of it, x < 0.5: u < 40.5, six columns (20 … 40).
  EXPECT_NEAR(errors.both.share, 6.0 / 13, 1e-12);
  // Seen by the left camera: u = 0 … 76, 20 columns, eleven of them up to 40.
  EXPECT_NEAR(errors.left.share, 11.0 / 20, 1e-12);
}

TEST(ModelErrors, TheTissueThatBothSeeIsEightPixelsInside) {
  const Moment moment;
  const TissueSamples samples = sampleVisibleTissue(moment.depth_mm, moment.rig);
  EXPECT_EQ(samples.points_left_mm.size(), 20u * 16u);
  std::size_t both = 0;
  for (const auto mark : samples.in_both) both += mark;
  EXPECT_EQ(both, 13u * 12u);  // v = 8 … 52
}

TEST(ModelErrors, APoseMovesTheCameraNotTheTissue) {
  Moment moment;
  TrueMoment truth = moment.truth();
  truth.world_from_left.translation() = Eigen::Vector3d(100, 0, 0);
  const ModelErrors errors = modelErrors({{0, 0, 50}, {100, 0, 50}}, truth);
  EXPECT_EQ(errors.each_observed, (std::vector<std::uint8_t>{0, 1}));
}

TEST(ModelErrors, WithoutDepthOnlyDistancesAreKnown) {
  const Moment moment;
  const Raster<float> none;
  const ModelErrors errors = modelErrors({{0, 0, 51}}, {moment.surface, none, moment.rig, {}});
  EXPECT_NEAR(errors.distance_mm.mean, 1, 1e-6);
  EXPECT_TRUE(std::isnan(errors.observed_share));
  EXPECT_TRUE(std::isnan(errors.both.share));
  EXPECT_TRUE(errors.each_observed.empty());
}

TEST(ModelErrors, NoPointsAndAForeignDepthAreRefused) {
  Moment moment;
  EXPECT_THROW(modelErrors({}, moment.truth()), InputError);
  moment.depth_mm = Raster<float>(10, 10, 50.0f);
  EXPECT_THROW(modelErrors({{0, 0, 50}}, moment.truth()), InputError);
}

TEST(ModelErrors, UnknownDepthShowsNothing) {
  Moment moment;
  moment.depth_mm = Raster<float>(80, 64, kNoPlace);
  const ModelErrors errors = modelErrors({{0, 0, 50}}, moment.truth());
  EXPECT_EQ(errors.each_observed[0], 0);
  EXPECT_TRUE(std::isnan(errors.both.share)) << "no tissue: a share of nothing is no number";
}

TEST(PointTree, FindsTheNearestOfManyAsBruteForceDoes) {
  std::mt19937 random(7);
  const auto points = pointsInCube(2000, 10, random), queries = pointsInCube(500, 15, random);
  const std::vector<double> found_mm = PointTree(points).distances_mm(queries);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& p : points)
      least = std::min(least, (p.cast<double>() - queries[i].cast<double>()).norm());
    ASSERT_NEAR(found_mm[i], least, 1e-9) << i;
  }
}

TEST(ErrorPool, ALargeModelCountsAsOftenAsASmallOne) {
  ModelErrors small, large;
  small.each_mm.assign(20000, 1.0);
  small.each_signed_mm.assign(20000, 1.0);
  large.each_mm.assign(60000, 3.0);
  large.each_signed_mm.assign(60000, -3.0);
  large.each_observed.assign(60000, 0);
  large.each_observed[0] = 1;
  ErrorPool pool(2);
  pool.add(small);
  pool.add(large);
  EXPECT_NEAR(statistics(pool.all_mm()).mean, 2, 1e-12);
  EXPECT_NEAR(statistics(pool.signed_mm()).mean, -1, 1e-12);
  EXPECT_EQ(pool.observed_mm().size(), 1u);
  EXPECT_EQ(pool.predicted_mm().size(), 19999u);
}

TEST(ErrorPool, KeepsSigmasBesideTheirErrors) {
  ModelErrors errors;
  errors.each_mm = {1, 2, 3};
  errors.each_signed_mm = {1, 2, 3};
  errors.each_observed = {0, 1, 0};
  errors.each_beyond = {0, 0, 1};
  ErrorPool pool(2);
  pool.add(errors, {10, 20, 30});
  pool.add(errors);
  ASSERT_EQ(pool.all_sigma_mm().size(), 6u);
  EXPECT_EQ(pool.all_sigma_mm()[2], 30);
  EXPECT_TRUE(std::isnan(pool.all_sigma_mm()[3])) << "the model has none";
  ASSERT_EQ(pool.observed_sigma_mm().size(), 2u);
  EXPECT_EQ(pool.observed_sigma_mm()[0], 20);
  ASSERT_EQ(pool.predicted_sigma_mm().size(), 2u);
  EXPECT_EQ(pool.predicted_sigma_mm()[0], 10);
}

TEST(ErrorPool, StaysWithinItsMemory) {
  ModelErrors errors;
  errors.each_mm.assign(30000, 1.0);
  errors.each_signed_mm.assign(30000, 1.0);
  ErrorPool pool(800000);
  pool.add(errors);
  EXPECT_EQ(pool.all_mm().size(), 10u) << "8 million over 800 000 moments";
}

}  // namespace
}  // namespace softscope
