// tests/fusion/surface_search_test.cpp: the model's surface around a few positions.
#include "fusion/surface_search.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fusion/surface_formulas.h"

namespace softscope {
namespace {

/// A point every 0.1 mm of a plane at the height, 4 x 4 mm.
PointModel planeAt(float z_mm) {
  PointModel model;
  for (int y = -20; y <= 20; ++y)
    for (int x = -20; x <= 20; ++x)
      model.add({0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), z_mm},
                Eigen::Vector3f::UnitZ(), Rgb8{}, 2);
  return model;
}

TEST(SurfaceSearch, MeasuresTheHeightOfAPlane) {
  const auto pieces =
      CpuSurfaceSearch().piecesAround(planeAt(10.2f), {{0, 0, 10}, {0.31, -0.52, 10.5}});
  EXPECT_NEAR(pieces[0].height_mm / pieces[0].weight, 0.2, 1e-6);
  EXPECT_NEAR(pieces[1].height_mm / pieces[1].weight, -0.3, 1e-6);
  for (const SurfacePiece& piece : pieces) EXPECT_DOUBLE_EQ(piece.normal.z(), piece.weight);
}

/// The sum of every point within the radius, found one by one.
TEST(SurfaceSearch, CountsEveryPointAround) {
  const PointModel model = planeAt(0);
  const Eigen::Vector3d middle(0.04, 0.03, 0.01);
  double weight = 0;
  for (const Eigen::Vector3f& point : model.positions_mm)
    weight += 2 * std::max(0.0, 1 - (point.cast<double>() - middle).squaredNorm() /
                                        (kSurfacePieceMm * kSurfacePieceMm));
  EXPECT_NEAR(CpuSurfaceSearch().piecesAround(model, {middle})[0].weight, weight, 1e-9);
}

TEST(SurfaceSearch, FindsNothingBeyondItsRadius) {
  const auto pieces = CpuSurfaceSearch().piecesAround(planeAt(0), {{0, 0, 0.71}, {50, 0, 0}});
  for (const SurfacePiece& piece : pieces) EXPECT_EQ(piece.weight, 0);
}

TEST(SurfaceSearch, LeavesOutWhatIsNotFiniteOrTooFar) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  PointModel model = planeAt(0);
  const Eigen::Vector3d middle(0.04, 0.03, 0.01);
  const double weight = CpuSurfaceSearch().piecesAround(model, {middle})[0].weight;
  for (const double wrong : {std::nan(""), kInfinity, -kInfinity, 1e30, -1e30})
    model.add(Eigen::Vector3d(wrong, 0, 0).cast<float>(), Eigen::Vector3f::UnitZ(), Rgb8{}, 2);
  const auto pieces =
      CpuSurfaceSearch().piecesAround(model, {middle, {0, std::nan(""), 0}, {0, 0, 1e30}});
  EXPECT_EQ(pieces[0].weight, weight);
  EXPECT_EQ(pieces[1].weight, 0);
  EXPECT_EQ(pieces[2].weight, 0);
}

TEST(SurfaceSearch, FindsTheNearestPointAndOfEquallyNearOnesTheFirst) {
  PointModel model = planeAt(0);
  const std::size_t count = model.size();
  model.add(model.positions_mm[7], Eigen::Vector3f::UnitZ(), Rgb8{}, 1);
  const std::vector<std::int32_t> nearest =
      CpuSurfaceSearch().nearestPoints(model, {model.positions_mm[7], {2.04f, 2.03f, 9}});
  EXPECT_EQ(nearest[0], 7);
  EXPECT_EQ(nearest[1], static_cast<std::int32_t>(count) - 1);
  EXPECT_EQ(CpuSurfaceSearch().nearestPoints(PointModel(), {Eigen::Vector3f::Zero()})[0], -1);
}

}  // namespace
}  // namespace softscope
