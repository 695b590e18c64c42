// tests/deform/surface_cells_test.cpp: cells of a whole model, and of a region of it.
#include "deform/graph/surface_cells.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <random>
#include <tuple>

namespace softscope {
namespace {

constexpr double kCellMm = 1;
using Positions = std::vector<Eigen::Vector3f>;

/// More than a part of the points that is numbered on its own, and some that have no cell.
Positions scatteredWall() {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> along(-60, 60), across(-1.5f, 1.5f);
  Positions positions_mm;
  for (int i = 0; i < 20000; ++i)
    positions_mm.emplace_back(along(random), along(random), across(random));
  positions_mm[700] = Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN());
  positions_mm[9000].x() = 3e6f;
  return positions_mm;
}

TEST(SurfaceCells, HaveTheMeanOfTheirPointsAndTheNearestToIt) {
  const Positions positions_mm = scatteredWall();
  std::map<std::tuple<int, int, int>, std::vector<int>> expected;
  const CellNumbering grid(kCellMm);
  Cube cube;
  for (std::size_t i = 0; i < positions_mm.size(); ++i)
    if (grid.cubeOf(positions_mm[i], &cube))
      expected[{cube.x, cube.y, cube.z}].push_back(static_cast<int>(i));
  const SurfaceCells cells(positions_mm, kCellMm);
  ASSERT_EQ(cells.size(), static_cast<int>(expected.size()));
  EXPECT_EQ(cells.cellAt(positions_mm[700]), -1);
  EXPECT_EQ(cells.cellAt(positions_mm[9000]), -1);
  for (const auto& [place, points] : expected) {
    const int cell = cells.cellAt(positions_mm[points.front()]);
    std::vector<int> found;
    cells.visitPoints(cell, [&](int point) { found.push_back(point); });
    ASSERT_EQ(found, points);
    Eigen::Vector3f mean_mm = Eigen::Vector3f::Zero();
    for (const int point : points) mean_mm += positions_mm[point];
    mean_mm /= static_cast<float>(points.size());
    EXPECT_EQ(cells.centre(cell), mean_mm);
    const float nearest_mm = (positions_mm[cells.representative(cell)] - mean_mm).norm();
    for (const int point : points)
      EXPECT_GE((positions_mm[point] - mean_mm).norm(), nearest_mm * (1 - 1e-6f));
  }
}

TEST(SurfaceRegion, HoldsAllWithinReachOfItsPoints) {
  const Positions positions_mm = scatteredWall();
  const std::vector<int> points{5, 700, 1200};  // one of them nowhere
  constexpr double kReachMm = 20;
  const SurfaceRegion region(positions_mm, points, kReachMm, kCellMm);
  int inside = 0;
  for (const Eigen::Vector3f& position_mm : positions_mm) {
    inside += region.contains(position_mm);
    for (const int point : points)
      if ((position_mm - positions_mm[point]).norm() <= kReachMm)
        EXPECT_TRUE(region.contains(position_mm)) << position_mm.transpose();
  }
  EXPECT_GT(inside, 1000);
  EXPECT_LT(inside, 13000);
  EXPECT_TRUE(SurfaceRegion(kCellMm).contains(Eigen::Vector3f(1e5f, 0, 0)));
}

TEST(SurfaceRegion, ItsCellsAreThoseOfTheWholeModel) {
  const Positions positions_mm = scatteredWall();
  const SurfaceRegion region(positions_mm, {5, 1200}, 20, kCellMm);
  const SurfaceCells all(positions_mm, kCellMm), some(positions_mm, kCellMm, region);
  EXPECT_GT(some.size(), 500);
  EXPECT_LT(some.size(), all.size() - 500);
  for (const Eigen::Vector3f& position_mm : positions_mm) {
    const int cell = some.cellAt(position_mm);
    ASSERT_EQ(cell >= 0, region.contains(position_mm) && all.cellAt(position_mm) >= 0);
    if (cell < 0) continue;
    EXPECT_EQ(some.centre(cell), all.centre(all.cellAt(position_mm)));
    EXPECT_EQ(some.representative(cell), all.representative(all.cellAt(position_mm)));
  }
}

}  // namespace
}  // namespace softscope
