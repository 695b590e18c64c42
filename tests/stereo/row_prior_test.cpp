// tests/stereo/row_prior_test.cpp: the prior between support points has exact values.
#include "stereo/matching/row_prior.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kStep = 5;

/// Support points of a plane on a grid; exact in binary, so the prior is, too.
float planeAt(int u, int v) {
  return 20 + 0.125f * static_cast<float>(u) - 0.0625f * static_cast<float>(v);
}
std::vector<SupportPoint> planePoints(int first, int last_u, int last_v) {
  std::vector<SupportPoint> points;
  for (int v = first; v <= last_v; v += kStep)
    for (int u = first; u <= last_u; u += kStep) points.push_back({u, v, planeAt(u, v)});
  return points;
}

/// Every pixel between the outermost points is on the plane; 1/16 px is half a unit.
void expectPlane(const Raster<std::int16_t>& prior, int first, int last_u, int last_v) {
  for (int v = first; v <= last_v; ++v)
    for (int u = first; u <= last_u; ++u)
      EXPECT_NEAR(prior.at(u, v) / 8.0, planeAt(u, v), 0.0626) << u << ", " << v;
}

TEST(RowPrior, IsAPlaneBetweenPointsOfAPlane) {
  expectPlane(interpolateRows(planePoints(5, 60, 40), 70, 50), 5, 60, 40);
}

TEST(RowPrior, IsAPlaneWhereWholeRowsOrColumnsAreMissing) {
  auto points = planePoints(5, 60, 40);
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const SupportPoint& p) {
                                return (p.v_px > 10 && p.v_px < 30) || (p.u_px > 20 && p.u_px < 45);
                              }),
               points.end());
  expectPlane(interpolateRows(points, 70, 50), 5, 60, 40);
}

TEST(RowPrior, TakesAHoleFromTheRowsAboveAndBelowIt) {
  // Rows 20 and 25 have points at the left border only: their evidence is far, rows 15 and 30 near.
  auto points = planePoints(5, 60, 40);
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const SupportPoint& p) {
                                return p.u_px > 5 && (p.v_px == 20 || p.v_px == 25);
                              }),
               points.end());
  const Raster<std::int16_t> prior = interpolateRows(points, 70, 50);
  for (int v = 15; v <= 30; ++v)
    for (int u = 15; u <= 60; u += kStep)
      EXPECT_NEAR(prior.at(u, v) / 8.0, planeAt(u, v), 0.0626) << u << ", " << v;
}

TEST(RowPrior, IsConstantBeyondTheOutermostPoints) {
  const Raster<std::int16_t> prior = interpolateRows({{10, 8, 24}, {30, 8, 34}}, 40, 20);
  for (int v = 0; v < 20; ++v) {
    EXPECT_EQ(prior.at(0, v), 8 * 24) << v;
    EXPECT_EQ(prior.at(10, v), 8 * 24) << v;
    EXPECT_EQ(prior.at(20, v), 8 * 29) << v;
    EXPECT_EQ(prior.at(39, v), 8 * 34) << v;
  }
}

TEST(RowPrior, TakesTheNearerSurfaceOfTwoOnOnePixelInAnyOrder) {
  const std::vector<SupportPoint> points = {{10, 8, 24}, {10, 8, 31}, {30, 16, 20}, {10, 8, 27}};
  const Raster<std::int16_t> prior = interpolateRows(points, 40, 20);
  EXPECT_EQ(prior.at(10, 8), 8 * 31);
  const std::vector<SupportPoint> reversed(points.rbegin(), points.rend());
  EXPECT_EQ(prior.values, interpolateRows(reversed, 40, 20).values);
}

TEST(RowPrior, IgnoresPointsOutsideTheImageAndKnowsNothingWithoutPoints) {
  for (const auto& points :
       {std::vector<SupportPoint>{}, {{-1, 5, 9}}, {{40, 5, 9}}, {{5, -5, 9}}, {{5, 20, 9}}})
    for (const std::int16_t value : interpolateRows(points, 40, 20).values)
      EXPECT_EQ(value, kNoPrior);
}

TEST(RowPrior, IsTheSameOnAnyNumberOfThreads) {
  std::vector<SupportPoint> points;
  for (int k = 0; k < 300; ++k)
    points.push_back({k * 37 % 200, k * 53 % 150 / kStep * kStep, static_cast<float>(k * 29 % 64)});
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return interpolateRows(points, 200, 150).values;
  };
  EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace softscope
