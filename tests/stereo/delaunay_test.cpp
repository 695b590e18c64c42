// tests/stereo/delaunay_test.cpp: the triangulation is Delaunay's, also where points are
// degenerate.
#include "stereo/matching/delaunay.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <set>

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

/// > 0 where d lies strictly inside the circle through a, b, c; exact for coordinates up to
/// thousands.
bool strictlyInside(Eigen::Vector2i a, Eigen::Vector2i b, Eigen::Vector2i c, Eigen::Vector2i d) {
  const auto row = [&](const Eigen::Vector2i& p) {
    const long x = p.x() - d.x(), y = p.y() - d.y();
    return std::array<long, 3>{x, y, x * x + y * y};
  };
  const auto p = row(a), q = row(b), r = row(c);
  const auto inside = p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) +
                      p[2] * (q[0] * r[1] - q[1] * r[0]);
  const Eigen::Vector2i ab = b - a, ac = c - a;
  const long turn = static_cast<long>(ab.x()) * ac.y() - static_cast<long>(ab.y()) * ac.x();
  return turn > 0 ? inside > 0 : inside < 0;
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

}  // namespace
}  // namespace softscope
