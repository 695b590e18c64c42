// tests/stereo/dense_depth_test.cpp: gaps are filled, and their predicted errors are true.
#include "stereo/depth/dense_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/error.h"

namespace softscope {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
using Surface = std::function<double(int u, int v)>;  // depth, mm

/// Tissue of 160 x 120 pixels, everywhere measured.
DepthMap measuredOf(const Surface& depth_mm) {
  DepthMap depth{Raster<float>(160, 120), Raster<float>(160, 120, 0.1f)};
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) depth.depth_mm.at(u, v) = float(depth_mm(u, v));
  return depth;
}

void cut(DepthMap& depth, int u0, int v0, int width, int height) {
  for (int v = v0; v < v0 + height; ++v)
    for (int u = u0; u < u0 + width; ++u) depth.depth_mm.at(u, v) = depth.sigma_mm.at(u, v) = kNone;
}

/// Inverse depth is linear in the pixel.
double slanted(int u, int v) { return 1 / (0.018 + 2e-5 * u - 1e-5 * v); }

/// Bumps of about 1.5 mm over a ball, 20 to 60 px wide.
double relief(int u, int v) {
  const double x = u / 160.0 - 0.5, y = v / 120.0 - 0.5;
  return 55 + 12 * (x * x + y * y) + 0.8 * std::sin(0.11 * u + 0.05 * v) +
         0.7 * std::cos(0.13 * v - 0.04 * u);
}

TEST(DenseDepth, FillsAPlaneExactly) {
  DepthMap depth = measuredOf(slanted);
  cut(depth, 0, 0, 25, 120);   // what only one camera sees
  cut(depth, 70, 40, 30, 30);  // a hole
  const DepthMap dense = denseDepth(depth, Mask());
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      ASSERT_NEAR(dense.depth_mm.at(u, v), slanted(u, v), 1e-3) << u << ", " << v;
      ASSERT_LT(dense.sigma_mm.at(u, v), 0.101) << u << ", " << v;
    }
}

TEST(DenseDepth, KeepsWhatWasMeasuredAndWhatIsIgnored) {
  DepthMap depth = measuredOf(relief);
  cut(depth, 30, 30, 40, 20);
  Mask ignored(160, 120);
  for (int v = 80; v < 120; ++v)
    for (int u = 0; u < 50; ++u) ignored.at(u, v) = 1;
  cut(depth, 0, 80, 50, 40);
  const DepthMap dense = denseDepth(depth, ignored);
  for (int v = 0; v < 120; ++v)
    for (int u = 0; u < 160; ++u) {
      const float before = depth.depth_mm.at(u, v), now = dense.depth_mm.at(u, v);
      if (std::isfinite(before)) {
        ASSERT_EQ(now, before);
        ASSERT_EQ(dense.sigma_mm.at(u, v), depth.sigma_mm.at(u, v));
      } else {
        ASSERT_EQ(std::isfinite(now), ignored.at(u, v) == 0) << u << ", " << v;
        ASSERT_EQ(std::isfinite(dense.sigma_mm.at(u, v)), ignored.at(u, v) == 0);
      }
    }
}

// Gaps at the edge and inside, at places that chance gives, on a surface without steps: the
// intervals hold their share and more.
TEST(DenseDepth, PredictsItsErrors) {
  std::mt19937 random(5);
  int within_one = 0, within_two = 0, count = 0;
  for (int trial = 0; trial < 10; ++trial) {
    const double shift = 37.0 * trial;
    const Surface truth = [&](int u, int v) {
      return relief(u, v) + 0.5 * std::sin(0.2 * (u + shift));
    };
    DepthMap depth = measuredOf(truth);
    cut(depth, 0, 0, 15, 120);
    for (int hole = 0; hole < 8; ++hole)
      cut(depth, 20 + int(random() % 110), int(random() % 90), 8 + int(random() % 20),
          8 + int(random() % 20));
    const DepthMap dense = denseDepth(depth, Mask());
    for (int v = 0; v < 120; ++v)
      for (int u = 0; u < 160; ++u) {
        if (std::isfinite(depth.depth_mm.at(u, v))) continue;
        const double error = std::abs(dense.depth_mm.at(u, v) - truth(u, v));
        within_one += error < dense.sigma_mm.at(u, v);
        within_two += error < 1.96 * dense.sigma_mm.at(u, v);
        ++count;
      }
  }
  EXPECT_GT(within_one, 0.60 * count);
  EXPECT_GT(within_two, 0.90 * count);
  EXPECT_LT(within_one, 0.93 * count) << "wider than it need be";
}

// The step may lie anywhere in the gap: both surfaces are within two standard errors.
TEST(DenseDepth, IsUnsureBetweenANearAndAFarSurface) {
  DepthMap depth = measuredOf([](int u, int) { return u < 80 ? 45.0 : 60.0; });
  cut(depth, 70, 0, 20, 120);
  const DepthMap dense = denseDepth(depth, Mask());
  for (int u = 76; u < 84; ++u) {
    const float here_mm = dense.depth_mm.at(u, 60), sigma_mm = dense.sigma_mm.at(u, 60);
    EXPECT_LT(here_mm - 45, 2 * sigma_mm) << u;
    EXPECT_LT(60 - here_mm, 2 * sigma_mm) << u;
  }
}

TEST(DenseDepth, IsFartherFromTheTruthFartherAway) {
  DepthMap depth = measuredOf(relief);
  cut(depth, 60, 30, 50, 50);
  const DepthMap dense = denseDepth(depth, Mask());
  EXPECT_GT(dense.sigma_mm.at(85, 55), 1.5f * dense.sigma_mm.at(61, 31));
}

TEST(DenseDepth, GivesTheSameBytesTwice) {
  DepthMap depth = measuredOf(relief);
  cut(depth, 60, 30, 50, 50);
  const DepthMap once = denseDepth(depth, Mask()), twice = denseDepth(depth, Mask());
  EXPECT_EQ(once.depth_mm.values, twice.depth_mm.values);
}

TEST(DenseDepth, NeedsSomethingMeasured) {
  DepthMap depth = measuredOf(relief);
  cut(depth, 0, 0, 160, 119);
  EXPECT_TRUE(std::isfinite(denseDepth(depth, Mask()).depth_mm.at(10, 10)));
  cut(depth, 0, 0, 120, 120);
  EXPECT_THROW(denseDepth(depth, Mask()), InputError);
}

// Depth from a file has no standard error; what is filled has one all the same.
TEST(DenseDepth, FillsDepthWithoutStandardErrors) {
  DepthMap depth = measuredOf(relief);
  cut(depth, 60, 30, 50, 50);
  depth.sigma_mm = {};
  const DepthMap dense = denseDepth(depth, Mask());
  EXPECT_TRUE(std::isfinite(dense.sigma_mm.at(85, 55)));
  EXPECT_TRUE(std::isnan(dense.sigma_mm.at(5, 5)));
}

}  // namespace
}  // namespace softscope
