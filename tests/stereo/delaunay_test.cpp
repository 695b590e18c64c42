// tests/stereo/delaunay_test.cpp: the triangulation is Delaunay's and unique, also where points are
// degenerate.
#include "stereo/matching/delaunay.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <set>

#include "core/error.h"

namespace softscope {
namespace {

using Points = std::vector<Eigen::Vector2i>;

long doubleArea(const Points& p, const std::array<int, 3>& t) {
  const Eigen::Vector2i ab = p[t[1]] - p[t[0]], ac = p[t[2]] - p[t[0]];
  return std::abs(static_cast<long>(ab.x()) * ac.y() - static_cast<long>(ab.y()) * ac.x());
}

long doubleArea(const Points& p, const std::vector<std::array<int, 3>>& triangles) {
  long sum = 0;
  for (const auto& t : triangles) sum += doubleArea(p, t);
  return sum;
}

/// > 0 if d is strictly inside the circle through a, b,
/// c, 0 on it; exact for coordinates up to thousands.
long inCircle(Eigen::Vector2i a, Eigen::Vector2i b, Eigen::Vector2i c, Eigen::Vector2i d) {
  const auto row = [&](const Eigen::Vector2i& p) {
    const long x = p.x() - d.x(), y = p.y() - d.y();
    return std::array<long, 3>{x, y, x * x + y * y};
  };
  const auto p = row(a), q = row(b), r = row(c);
  const auto inside = p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                      p[2] * (q[0] * r[1] - q[1] * r[0]);
  const Eigen::Vector2i ab = b - a, ac = c - a;
  const long turn = static_cast<long>(ab.x()) * ac.y() - static_cast<long>(ab.y()) * ac.x();
  return turn > 0 ? inside : -inside;
}

bool strictlyInside(Eigen::Vector2i a, Eigen::Vector2i b, Eigen::Vector2i c, Eigen::Vector2i d) {
  return inCircle(a, b, c, d) > 0;
}

TEST(Delaunay, HasNoPointInsideAnyCircle) {
  std::mt19937 random(7);
  std::set<std::pair<int, int>> chosen;
  while (chosen.size() < 120)
    chosen.insert({static_cast<int>(random() % 200), static_cast<int>(random() % 150)});
  Points points;
  for (const auto& [x, y] : chosen) points.emplace_back(x, y);
  const auto triangles = delaunay(points);
  ASSERT_FALSE(triangles.empty());
  for (const auto& t : triangles)
    for (const Eigen::Vector2i& p : points)
      EXPECT_FALSE(strictlyInside(points[t[0]], points[t[1]], points[t[2]], p));
}

TEST(Delaunay, CoversAGridWhereEveryFourPointsLieOnOneCircle) {
  Points points;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) points.emplace_back(5 * x, 5 * y);
  EXPECT_EQ(doubleArea(points, delaunay(points)), 2L * (29 * 5) * (19 * 5));
}

TEST(Delaunay, CoversTheHullOfRandomPoints) {
  Points points = {{0, 0}, {1000, 0}, {0, 800}, {1000, 800}};
  std::mt19937 random(3);
  std::set<std::pair<int, int>> chosen;
  while (chosen.size() < 500)
    chosen.insert({static_cast<int>(1 + random() % 998), static_cast<int>(1 + random() % 798)});
  for (const auto& [x, y] : chosen) points.emplace_back(x, y);
  EXPECT_EQ(doubleArea(points, delaunay(points)), 2L * 1000 * 800);
}

TEST(Delaunay, FindsNoTriangleInFewOrCollinearPoints) {
  EXPECT_TRUE(delaunay({}).empty());
  EXPECT_TRUE(delaunay({{3, 4}}).empty());
  EXPECT_TRUE(delaunay({{3, 4}, {9, 1}}).empty());
  EXPECT_TRUE(delaunay({{0, 0}, {5, 5}, {10, 10}, {20, 20}}).empty());
}

using Corners = std::set<std::pair<int, int>>;  // (y, x): in raster order

std::vector<Corners> cornersOf(const Points& points, const std::vector<std::array<int, 3>>& found) {
  std::vector<Corners> out;
  for (const auto& t : found) {
    Corners corners;
    for (const int i : t) corners.insert({points[i].y(), points[i].x()});
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
}

/// Positive where a, b, c turn from the x axis to the y axis: clockwise on the screen.
long turn(const Eigen::Vector2i& a, const Eigen::Vector2i& b, const Eigen::Vector2i& c) {
  const Eigen::Vector2i ab = b - a, ac = c - a;
  return static_cast<long>(ab.x()) * ac.y() - static_cast<long>(ab.y()) * ac.x();
}

/// By definition: whether the result has the triangle i < j < k of distinct points in raster order.
bool belongs(const Points& p, std::size_t i, std::size_t j, std::size_t k) {
  const long side = turn(p[j], p[k], p[i]);
  if (side == 0) return false;
  for (std::size_t d = 0; d < p.size(); ++d) {
    if (d == i || d == j || d == k) continue;
    const long inside = inCircle(p[i], p[j], p[k], p[d]);
    if (inside > 0) return false;
    if (inside < 0) continue;
    if (d < i) return false;  // i isn't the first on the circle
    if ((turn(p[j], p[k], p[d]) > 0) != (side > 0)) return false;  // d is between j and k
  }
  return true;
}

std::vector<Corners> trianglesByDefinition(Points points) {
  std::sort(points.begin(), points.end(), [](const auto& p, const auto& q) {
    return std::pair(p.y(), p.x()) < std::pair(q.y(), q.x());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::array<int, 3>> found;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      for (std::size_t k = j + 1; k < points.size(); ++k)
        if (belongs(points, i, j, k))
          found.push_back({static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)});
  return cornersOf(points, found);
}

/// Points at random on a grid so small that many are equal, on one line or on one circle.
Points crowdedPoints(std::mt19937& random, unsigned count, unsigned width, unsigned height) {
  Points points;
  for (unsigned i = 0; i < count; ++i)
    points.emplace_back(static_cast<int>(random() % width), static_cast<int>(random() % height));
  return points;
}

TEST(Delaunay, AgreesWithItsDefinitionOnCrowdedSets) {
  std::mt19937 random(11);
  for (int set = 0; set < 4000; ++set) {
    const Points points = crowdedPoints(random, random() % 17, 1 + random() % 8, 1 + random() % 8);
    ASSERT_EQ(cornersOf(points, delaunay(points)), trianglesByDefinition(points)) << set;
  }
}

TEST(Delaunay, AgreesWithItsDefinitionOnACircleOfTwelvePoints) {
  const Points points = {{5, 0},  {4, 3},   {3, 4},   {0, 5},  {-3, 4}, {-4, 3},
                         {-5, 0}, {-4, -3}, {-3, -4}, {0, -5}, {3, -4}, {4, -3}};
  const auto found = cornersOf(points, delaunay(points));
  EXPECT_EQ(found.size(), 10U);
  EXPECT_EQ(found, trianglesByDefinition(points));
  for (const Corners& corners : found) EXPECT_EQ(*corners.begin(), std::pair(-5, 0));
}

TEST(Delaunay, FansASquareFromItsFirstCornerInRasterOrder) {
  const Points points = {{7, 9}, {7, 5}, {3, 9}, {3, 5}};
  EXPECT_EQ(delaunay(points), (std::vector<std::array<int, 3>>{{3, 2, 0}, {3, 0, 1}}));
}

TEST(Delaunay, DependsOnPositionsAlone) {
  std::mt19937 random(5);
  Points points;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x)
      if (random() % 3 == 0) points.emplace_back(5 * x, 5 * y);
  const auto positions = [](const Points& p, const std::vector<std::array<int, 3>>& triangles) {
    std::vector<std::array<Eigen::Vector2i, 3>> out;
    for (const auto& t : triangles) out.push_back({p[t[0]], p[t[1]], p[t[2]]});
    return out;
  };
  Points shuffled = points;
  for (int run = 0; run < 5; ++run) {
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    EXPECT_EQ(positions(shuffled, delaunay(shuffled)), positions(points, delaunay(points)));
  }
}

TEST(Delaunay, TurnsEveryTriangleCounterClockwiseOnTheScreen) {
  std::mt19937 random(9);
  const Points points = crowdedPoints(random, 900, 200, 150);
  const auto found = delaunay(points);
  ASSERT_FALSE(found.empty());
  for (const auto& t : found) EXPECT_LT(turn(points[t[0]], points[t[1]], points[t[2]]), 0);
}

TEST(Delaunay, UsesTheFirstOfEqualPoints) {
  const Points points = {{0, 0}, {4, 1}, {0, 0}, {1, 5}, {4, 1}, {1, 5}, {1, 5}};
  EXPECT_EQ(delaunay(points), (std::vector<std::array<int, 3>>{{0, 3, 1}}));
}

TEST(Delaunay, IsExactForTheLargestCoordinates) {
  std::mt19937 random(13);
  for (int set = 0; set < 300; ++set) {
    const Points points = crowdedPoints(random, 12, 8, 8);
    Points far = points;
    for (Eigen::Vector2i& p : far) p = p * ((1 << 27) - 1) - Eigen::Vector2i(1 << 30, 1 << 29);
    ASSERT_EQ(delaunay(far), delaunay(points)) << set;
  }
}

TEST(Delaunay, TellsAPointOnALargeCircleFromOneAPixelInsideOrOutside) {
  constexpr int kRadius = (1 << 29) - 2;
  using Triangles = std::vector<std::array<int, 3>>;
  const auto found = [&](int lowest) {  // corners in raster order: top, left, right, bottom
    return delaunay({{0, -kRadius}, {-kRadius, 0}, {kRadius, 0}, {0, lowest}});
  };
  const Triangles from_top = {{0, 1, 3}, {0, 3, 2}}, from_left = {{0, 1, 2}, {1, 3, 2}};
  EXPECT_EQ(found(kRadius), from_top);
  EXPECT_EQ(found(kRadius - 1), from_top);
  EXPECT_EQ(found(kRadius + 1), from_left);
}

TEST(Delaunay, RejectsPointsTooFarApart) {
  EXPECT_THROW(delaunay({{0, 0}, {1 << 30, 0}, {0, 1}}), Error);
  EXPECT_THROW(delaunay({{0, -2000000000}, {1, 2000000000}, {2, 1}}), Error);
}

}  // namespace
}  // namespace softscope
