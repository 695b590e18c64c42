// tests/stereo/relief_error_test.cpp: how far surfaces bend within a window, and what it adds.
#include "stereo/depth/relief_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "core/parallel.h"

namespace softscope {
namespace {

constexpr int kReliefWidth = 90, kReliefHeight = 70;
constexpr double kFocalPx = 560, kBaselineMm = 5.2;
constexpr int kReachPx = 12;  // of the windows

RectifiedRig reliefRig() {
  RectifiedRig rig;
  rig.left.width_px = kReliefWidth;
  rig.left.height_px = kReliefHeight;
  rig.left.fx_px = rig.left.fy_px = kFocalPx;
  rig.baseline_mm = kBaselineMm;
  return rig;
}

Raster<float> depthOf(const std::function<double(int u, int v)>& disparity_px) {
  Raster<float> depth_mm(kReliefWidth, kReliefHeight);
  for (int v = 0; v < kReliefHeight; ++v)
    for (int u = 0; u < kReliefWidth; ++u)
      depth_mm.at(u, v) = static_cast<float>(kFocalPx * kBaselineMm / disparity_px(u, v));
  return depth_mm;
}

/// Disparities count in 1024ths of a pixel; window means round to a few of them.
constexpr double kRoundedPx = 0.002;

void expectNone(const Raster<float>& error_px) {
  for (int v = 0; v < kReliefHeight; ++v)
    for (int u = 0; u < kReliefWidth; ++u)
      EXPECT_LT(error_px.at(u, v), kRoundedPx) << u << " " << v;
}

TEST(ReliefError, APlaneHasNone) {
  const auto plane = depthOf([](int u, int v) { return 50 + 0.25 * u - 0.125 * v; });
  expectNone(reliefErrorPx(plane, reliefRig()));
}

TEST(ReliefError, ADepthStepIsNone) {
  const auto bar_px = [](int u, int v) {
    const double behind = 40 + 0.125 * u;
    return u > 30 && u < 50 && v > 20 ? behind + 6 : behind;
  };
  expectNone(reliefErrorPx(depthOf(bar_px), reliefRig()));
  Raster<float> with_gap = depthOf(bar_px);  // stereo removes pixels next to steps
  for (int v = 21; v < kReliefHeight; ++v)
    for (const int u : {29, 30, 31, 49, 50}) with_gap.at(u, v) = 0;
  const Raster<float> error_px = reliefErrorPx(with_gap, reliefRig());
  for (const float error : error_px.values) EXPECT_FALSE(error >= 3 * kRoundedPx);
}

/// Windows at the step show less bend, so those of its neighbours count, too.
TEST(ReliefError, OfCurvedTissueIsKnownUpToAStep) {
  constexpr double kBend = 0.004;
  const auto edge = depthOf([](int u, int) { return u < 45 ? 50 + kBend * u * u : 20; });
  const Raster<float> error_px = reliefErrorPx(edge, reliefRig());
  const double inside_px = error_px.at(20, 35);
  EXPECT_GT(error_px.at(44, 35), 0.3 * inside_px);
  EXPECT_LT(error_px.at(44, 35), 1.1 * inside_px);
  EXPECT_LT(error_px.at(46, 35), kRoundedPx);
}

/// A window of n pixels sees u² as (n² - 1) / 12 more than it is in the middle.
TEST(ReliefError, OfAParabolaIsWhatItsWindowLevelsOut) {
  constexpr double kBend = 0.004;
  const auto trough = depthOf([](int u, int) { return 50 + kBend * (u - 45) * (u - 45); });
  const Raster<float> error_px = reliefErrorPx(trough, reliefRig());
  const double expected_px = kBend * (25 * 25 - 1) / 12;
  for (int u = 2 * kReachPx; u < kReliefWidth - 2 * kReachPx; ++u)
    EXPECT_NEAR(error_px.at(u, kReliefHeight / 2), expected_px, 0.002) << u;
}

TEST(ReliefError, WhatWasNotMeasuredCountsNowhereAndHasNone) {
  Raster<float> depth_mm = depthOf([](int, int) { return 60; });
  for (int u = 30; u < 60; ++u)
    depth_mm.at(u, 35) = u % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : 0.0f;
  const Raster<float> error_px = reliefErrorPx(depth_mm, reliefRig());
  EXPECT_TRUE(std::isnan(error_px.at(30, 35)));
  EXPECT_TRUE(std::isnan(error_px.at(31, 35)));
  EXPECT_FLOAT_EQ(error_px.at(40, 36), 0);
  EXPECT_FLOAT_EQ(error_px.at(0, 0), 0);
}

TEST(ReliefError, IsAddedToBothStandardErrors) {
  const RectifiedRig rig = reliefRig();
  DepthMap depth{depthOf([](int u, int) { return 50 + 0.004 * u * u; }),
                 Raster<float>(kReliefWidth, kReliefHeight, 0.3f)};
  DisparityMap disparity{Raster<float>(kReliefWidth, kReliefHeight, 50),
                         Raster<float>(kReliefWidth, kReliefHeight, 0.2f)};
  const float error_px = reliefErrorPx(depth.depth_mm, rig).at(45, 35);
  const float z_mm = depth.depth_mm.at(45, 35);
  const double error_mm = z_mm * z_mm / (kFocalPx * kBaselineMm) * error_px;
  addReliefError(rig, &disparity, &depth);
  EXPECT_NEAR(disparity.sigma_px.at(45, 35), std::hypot(0.2f, error_px), 1e-6);
  EXPECT_NEAR(depth.sigma_mm.at(45, 35), std::hypot(0.3, error_mm), 1e-6);

  DepthMap exact{depth.depth_mm, {}};  // brought by the sequence, without errors
  addReliefError(rig, nullptr, &exact);
  EXPECT_TRUE(exact.sigma_mm.empty());
}

TEST(ReliefError, HasTheSameBytesOnAnyNumberOfThreads) {
  const auto waves =
      depthOf([](int u, int v) { return 50 + std::sin(0.3 * u + 0.2 * v) + 0.02 * v; });
  const Raster<float> shared = reliefErrorPx(waves, reliefRig());
  const ThreadLimit one(1);
  const Raster<float> alone = reliefErrorPx(waves, reliefRig());
  EXPECT_EQ(std::memcmp(shared.row(0), alone.row(0), shared.size() * sizeof(float)), 0);
}

/// Nearer than any disparity that is sought: no overflow.
TEST(ReliefError, OfDepthNextToTheLensIsFinite) {
  const auto wall = depthOf([](int u, int) { return u < 45 ? 1e6 : 1; });
  const Raster<float> error_px = reliefErrorPx(wall, reliefRig());
  for (const float error : error_px.values) EXPECT_TRUE(error >= 0 && error < 10);
}

}  // namespace
}  // namespace softscope
