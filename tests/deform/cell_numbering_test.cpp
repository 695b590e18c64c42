// tests/deform/cell_numbering_test.cpp: cubes, their numbers and neighbours.
#include "deform/graph/cell_numbering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace softscope {
namespace {

Cube cubeOf(const CellNumbering& table, const Eigen::Vector3f& point_mm) {
  Cube cube;
  EXPECT_TRUE(table.cubeOf(point_mm, &cube));
  return cube;
}

/// Points of a ball of some blocks about the origin, where coordinates change their sign.
std::vector<Eigen::Vector3f> scatteredPoints() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> along(-15, 15);
  std::vector<Eigen::Vector3f> points;
  for (int i = 0; i < 3000; ++i) points.emplace_back(along(random), along(random), along(random));
  return points;
}

TEST(CellNumbering, ACubeIsHalfOpenOnBothSidesOfTheOrigin) {
  const CellNumbering table(2);
  const Cube origin = cubeOf(table, {0, 0, 0});
  EXPECT_EQ(cubeOf(table, {1.99f, 0, 0}), origin);
  EXPECT_EQ(cubeOf(table, {2, 0, 0}).x, origin.x + 1);
  EXPECT_EQ(cubeOf(table, {0, -0.01f, 0}).y, origin.y - 1);
  EXPECT_EQ(cubeOf(table, {0, 0, -2}).z, origin.z - 1);
  EXPECT_EQ(cubeOf(table, {0, 0, -2.01f}).z, origin.z - 2);
}

TEST(CellNumbering, RefusesPointsOutsideOfTheGrid) {
  const CellNumbering table(1);
  Cube cube;
  EXPECT_TRUE(table.cubeOf({1e6f, -1e6f, 0}, &cube));
  EXPECT_FALSE(table.cubeOf({0, 1.1e6f, 0}, &cube));
  EXPECT_FALSE(table.cubeOf({-1.1e6f, 0, 0}, &cube));
  EXPECT_FALSE(table.cubeOf({0, 0, std::numeric_limits<float>::quiet_NaN()}, &cube));
  EXPECT_FALSE(table.cubeOf({0, 0, std::numeric_limits<float>::infinity()}, &cube));
}

TEST(CellNumbering, NumbersCubesInOrderOfTheirFirstUse) {
  CellNumbering table(1);
  std::vector<Cube> expected;
  for (const Eigen::Vector3f& point : scatteredPoints()) {
    const Cube cube = cubeOf(table, point);
    const auto known = std::find(expected.begin(), expected.end(), cube);
    const int number = static_cast<int>(known - expected.begin());
    EXPECT_EQ(table.find(cube), known == expected.end() ? -1 : number);
    EXPECT_EQ(table.findOrAdd(cube), number);
    if (known == expected.end()) expected.push_back(cube);
  }
  ASSERT_EQ(table.size(), static_cast<int>(expected.size()));
  EXPECT_GT(table.size(), 2000);
  for (int cell = 0; cell < table.size(); ++cell) {
    EXPECT_EQ(table.cube(cell), expected[static_cast<std::size_t>(cell)]);
    EXPECT_EQ(table.find(table.cube(cell)), cell);
  }
}

TEST(CellNumbering, FindsTheNeighboursOfEachCell) {
  CellNumbering table(1);
  for (const Eigen::Vector3f& point : scatteredPoints()) table.findOrAdd(cubeOf(table, point));
  std::vector<std::vector<int>> found(static_cast<std::size_t>(table.size()));
  for (int block = 0; block < table.blocks(); ++block)
    BlockWithRim(table, block).visitTouching([&](int cell, int other) {
      found[static_cast<std::size_t>(cell)].push_back(other);
    });
  int across_blocks = 0;
  for (int cell = 0; cell < table.size(); ++cell) {
    const Cube& centre = table.cube(cell);
    std::vector<int> expected;
    for (int dz = -1; dz <= 1; ++dz)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
          const int other = table.find({centre.x + dx, centre.y + dy, centre.z + dz});
          if (other >= 0 && other != cell) expected.push_back(other);
        }
    EXPECT_EQ(found[static_cast<std::size_t>(cell)], expected);
    for (const int other : expected)
      across_blocks += &table.blockOf(table.cube(other)) != &table.blockOf(centre);
  }
  EXPECT_GT(across_blocks, 100);
}

}  // namespace
}  // namespace softscope
