// tests/eval/surface_comparison_test.cpp: spheres, shifted planes and landmarks by closed formulas.
#include "eval/surfaces/surface_comparison.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "eval/alignment/landmark_errors.h"
#include "eval/made_shapes.h"
#include "eval/statistics/weighted_statistics.h"

namespace softscope {
namespace {

TriangleMesh shifted(TriangleMesh mesh, const Eigen::Vector3f& by_mm) {
  for (Eigen::Vector3f& v : mesh.vertices_mm) v += by_mm;
  return mesh;
}

TEST(SurfaceComparison, ConcentricSpheresAreOneRadiusApart) {
  // The larger one's vertices lie over vertices of the smaller, which are what is closest to them.
  const TriangleMesh small = makeSphere(60, 40, 30), large = makeSphere(60, 40, 32);
  const SurfaceComparison c = compareSurfaces(small, large, {1.999, 2.001});
  EXPECT_NEAR(c.accuracy.vertices_mm.mean, 2, 1e-5) << "floats near 30";
  EXPECT_NEAR(c.accuracy.area_mm.median, 2, 1e-5);
  EXPECT_NEAR(c.signed_mm.mean, 2, 1e-5) << "outside";
  EXPECT_NEAR(c.completeness.vertices_mm.max, 2, 0.01) << "to the larger one's flat triangles";
  EXPECT_EQ(c.scores[0].precision, 0);
  EXPECT_EQ(c.scores[1].precision, 1);
  EXPECT_EQ(c.scores[1].recall, 1);
  EXPECT_NEAR(c.scores[1].surface_dice, 1, 1e-12);
  EXPECT_NEAR(compareSurfaces(large, small, {}).signed_mm.max, -1.9, 0.1) << "inside";
}

TEST(SurfaceComparison, AShiftedPlaneThatReachesBeyondKnowsItsShares) {
  // 10 x 10 mm in steps of 1; the test is 1 mm above and 5 mm farther right.
  const TriangleMesh reference = makeRectangle(10, 10, 10, 10);
  const TriangleMesh test = shifted(reference, {5, 0, 1});
  const SurfaceComparison c = compareSurfaces(reference, test, {1.2});
  // Six of eleven columns are above the reference, the others 1 … 5 mm outside of it.
  EXPECT_NEAR(c.scores[0].precision, 6.0 / 11, 1e-12);
  EXPECT_NEAR(c.scores[0].recall, 6.0 / 11, 1e-12);
  EXPECT_NEAR(c.scores[0].f_score, 6.0 / 11, 1e-12);
  EXPECT_NEAR(c.scores[0].surface_dice, 0.55, 1e-6) << "five columns of area 1, a rim of a half";
  EXPECT_NEAR(c.accuracy.vertices_mm.max, std::sqrt(26), 1e-6);
  EXPECT_EQ(c.signed_mm.nan_count, 11u * 11 - 9 * 5) << "what is closest to the border has no side";
}

TEST(SurfaceComparison, PointsHaveNoArea) {
  TriangleMesh points;
  points.vertices_mm = {{1, 1, 0.5f}, {2, 2, 0.5f}};
  const SurfaceComparison c = compareSurfaces(makeRectangle(4, 4, 2, 2), points, {1});
  EXPECT_NEAR(c.accuracy.vertices_mm.mean, 0.5, 1e-6);
  EXPECT_TRUE(std::isnan(c.accuracy.area_mm.mean));
  EXPECT_TRUE(std::isnan(c.scores[0].surface_dice));
  EXPECT_NEAR(c.completeness.vertices_mm.max, std::sqrt(8.25), 1e-6) << "from the corner (4, 4)";
  EXPECT_THROW(compareSurfaces(makeRectangle(4, 4, 2, 2), {}, {1}), InputError);
  EXPECT_THROW(compareSurfaces(makeRectangle(4, 4, 2, 2), points, {0}), OptionError);
}

TEST(WeightedStatistics, OfEqualWeightsAreTheUsualOnes) {
  const std::vector<double> values{4, -1, 7, 2, 3, std::nan("")};
  const Statistics weighted = weightedStatistics(values, std::vector<double>(6, 2.5));
  const Statistics usual = statistics(values);
  EXPECT_EQ(weighted.count, usual.count);
  EXPECT_NEAR(weighted.mean, usual.mean, 1e-12);
  EXPECT_NEAR(weighted.sd, usual.sd, 1e-12);
  EXPECT_NEAR(weighted.rmse, usual.rmse, 1e-12);
  EXPECT_NEAR(weighted.median, usual.median, 1e-12);
}

TEST(WeightedStatistics, AHeavyValueCountsForMany) {
  const Statistics s = weightedStatistics({1, 5, 100}, {9, 1, 0});
  EXPECT_NEAR(s.mean, 1.4, 1e-12);
  EXPECT_EQ(s.max, 5) << "no weight, no value";
  // Middles of the weights: 4.5 and 9.5 of 10; the median, 5, is at a tenth between them.
  EXPECT_NEAR(s.median, 1.4, 1e-12);
  EXPECT_EQ(s.p95, 5);
  EXPECT_THROW(weightedStatistics({1}, {}), InputError);
  EXPECT_THROW(weightedStatistics({1}, {-1}), InputError);
}

TEST(WeightedStatistics, VerticesShareTheAreaOfTheirTriangles) {
  const auto areas_mm2 = vertexAreas_mm2(makeRectangle(2, 3, 1, 1));
  EXPECT_NEAR(areas_mm2[0] + areas_mm2[1] + areas_mm2[2] + areas_mm2[3], 6, 1e-12);
  EXPECT_NEAR(areas_mm2[0], 2, 1e-12) << "a corner of both triangles";
  EXPECT_NEAR(areas_mm2[1], 1, 1e-12);
}

TEST(LandmarkErrors, AnExactFitHasNeither) {
  const std::vector<Eigen::Vector3d> test{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 1, 0).normalized());
  std::vector<Eigen::Vector3d> reference;
  for (const auto& p : test) reference.push_back(motion * p);
  const LandmarkErrors errors = landmarkErrors(test, reference);
  EXPECT_TRUE(errors.fit.target_from_source.isApprox(motion, 1e-9));
  EXPECT_LT(errors.fre_mm.max, 1e-9);
  EXPECT_LT(errors.tre_mm.max, 1e-9);
}

TEST(LandmarkErrors, TheErrorAtAPointThatWasLeftOutIsLarger) {
  std::vector<Eigen::Vector3d> test{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}};
  std::vector<Eigen::Vector3d> reference = test;
  reference[3].z() += 1;  // seen only by the fits that hold it
  const LandmarkErrors errors = landmarkErrors(test, reference);
  EXPECT_GT(errors.tre_mm.max, 1 - 1e-9) << "without it the others fit exactly";
  EXPECT_LT(errors.fre_mm.max, 0.5);
}

TEST(LandmarkErrors, ThreeHaveNoTreAndALineNoFit) {
  const std::vector<Eigen::Vector3d> three{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
  EXPECT_EQ(landmarkErrors(three, three).tre_mm.count, 0u);
  const std::vector<Eigen::Vector3d> line{{0, 0, 0}, {10, 0, 0}, {20, 0, 0}};
  EXPECT_THROW(landmarkErrors(line, line), InputError);
}

}  // namespace
}  // namespace softscope
