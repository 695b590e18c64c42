// tests/vtk_views/test_point_splats.cpp: points as pieces of a surface.
#include <gtest/gtest.h>

#include <cmath>

#include "vtk_views/scenes/point_splats.h"

namespace softscope {
namespace {

constexpr int kCorners = 9;  // of a piece, its point first
constexpr int kHalf = 60;
constexpr std::size_t kMiddle = kHalf * (2 * kHalf + 1) + kHalf;

/// A square of 121 x 121 points, 0.5 mm apart, that leans by 45 degrees; black left of x = 0, else
/// white; errors rise with y.
SceneSurface leaningSquare() {
  SceneSurface square;
  for (int v = -kHalf; v <= kHalf; ++v)
    for (int u = -kHalf; u <= kHalf; ++u) {
      const float x = 0.5f * float(u), along = 0.5f * float(v);
      square.mesh.vertices_mm.emplace_back(x, along * std::sqrt(0.5f), along * std::sqrt(0.5f));
      square.mesh.colours.push_back(u < 0 ? Rgb8{0, 0, 0} : Rgb8{250, 250, 250});
      square.errors_mm.push_back(0.1 * v);
    }
  return square;
}

const Eigen::Vector3f kEye(0, 0, -50);

TEST(PointSplats, LieInTheSurfaceAndCoverIt) {
  const SceneSurface points = leaningSquare(), splats = splatsOf(points, 1, kEye);
  const std::size_t count = points.mesh.vertices_mm.size();
  ASSERT_EQ(splats.mesh.vertices_mm.size(), count * kCorners);
  ASSERT_EQ(splats.mesh.triangles.size(), count * (kCorners - 1));
  const Eigen::Vector3f normal = Eigen::Vector3f(0, 1, -1).normalized();  // towards the eye
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f& point = points.mesh.vertices_mm[i];
    ASSERT_EQ(splats.mesh.vertices_mm[i * kCorners], point);
    for (std::size_t k = 1; k < kCorners; ++k) {
      const Eigen::Vector3f way = splats.mesh.vertices_mm[i * kCorners + k] - point;
      const float behind = -way.dot(normal), beside = (way + behind * normal).norm();
      EXPECT_GT(behind, 0) << i << ": the nearest point's colour is seen";
      EXPECT_LT(behind, 0.1f * beside);
      EXPECT_GT(beside, 0.36f) << "half of the diagonal between neighbours: no holes";
      EXPECT_LT(beside, 1.0f) << i << ": no wider than two spacings, at the border too";
    }
  }
}

TEST(PointSplats, ColoursAndErrorsGoOverIntoThoseOfTheNeighbours) {
  const SceneSurface points = leaningSquare(), splats = splatsOf(points, 1, kEye);
  // White, next to black ones on its left.
  EXPECT_GT(splats.mesh.colours[kMiddle * kCorners].red, 200);
  int least = 255, most = 0;
  double low = 1, high = -1;
  for (std::size_t k = 1; k < kCorners; ++k) {
    const std::size_t at = kMiddle * kCorners + k;
    least = std::min<int>(least, splats.mesh.colours[at].red);
    most = std::max<int>(most, splats.mesh.colours[at].red);
    low = std::min(low, splats.errors_mm[at]);
    high = std::max(high, splats.errors_mm[at]);
  }
  EXPECT_LT(least, 50);
  EXPECT_GT(most, 200);
  EXPECT_NEAR(splats.errors_mm[kMiddle * kCorners], 0, 1e-6);
  EXPECT_LT(low, -0.05);
  EXPECT_GT(high, 0.05);
}

TEST(PointSplats, WhereNothingIsKnownNothingIsMadeUp) {
  SceneSurface points = leaningSquare();
  points.errors_mm[kMiddle] = std::nan("");
  const SceneSurface splats = splatsOf(points, 1, kEye);
  for (std::size_t k = 0; k < kCorners; ++k)
    EXPECT_TRUE(std::isnan(splats.errors_mm[kMiddle * kCorners + k]));
  for (std::size_t k = 0; k < kCorners; ++k)
    EXPECT_TRUE(std::isfinite(splats.errors_mm[(kMiddle + 1) * kCorners + k]));
}

TEST(PointSplats, LonePointsFaceTheEyeAndSurfacesStay) {
  SceneSurface lone;
  lone.mesh.vertices_mm = {{0, 0, 0}};
  const SceneSurface splat = splatsOf(lone, 2, kEye);
  ASSERT_EQ(splat.mesh.vertices_mm.size(), std::size_t(kCorners));
  EXPECT_NEAR(splat.mesh.vertices_mm[1].head<2>().norm(),
              2 * splatsOf(lone, 1, kEye).mesh.vertices_mm[1].head<2>().norm(), 1e-5);
  EXPECT_TRUE(splat.mesh.colours.empty());
  SceneSurface surface = lone;
  surface.mesh.vertices_mm = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(splatsOf(surface, 1, kEye).mesh.vertices_mm.size(), 3u);
  EXPECT_TRUE(splatsOf(SceneSurface(), 1, kEye).mesh.vertices_mm.empty());
}

}  // namespace
}  // namespace softscope
