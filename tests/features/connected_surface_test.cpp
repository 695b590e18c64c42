// tests/features/connected_surface_test.cpp: which pixels show the surface of one.
#include "features/connected_surface.h"

#include <gtest/gtest.h>

#include <limits>

#include "features/first_look.h"

namespace softscope {
namespace {

constexpr double kFocalPx = 300;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// 60 mm away left of column 50, `behind_mm` farther from there on.
DepthMap stepped(float behind_mm) {
  DepthMap depth{Raster<float>(100, 80, 60.0F), Raster<float>(100, 80, 0.1F)};
  for (int v = 0; v < 80; ++v)
    for (int u = 50; u < 100; ++u) depth.depth_mm.at(u, v) += behind_mm;
  return depth;
}

TEST(ConnectedSurface, EndsAtAStepOfDepth) {
  const ConnectedSurface surface(stepped(5), {40, 40}, kFocalPx, 20);
  ASSERT_TRUE(surface.found());
  EXPECT_TRUE(surface.holds({49, 40}, 0));
  EXPECT_FALSE(surface.holds({50, 40}, 0));
  EXPECT_TRUE(surface.holds({47, 40}, 2));
  EXPECT_FALSE(surface.holds({48, 40}, 2));
}

TEST(ConnectedSurface, EndsWhereDepthIsMissing) {
  EXPECT_FALSE(ConnectedSurface(stepped(kNone), {40, 40}, kFocalPx, 20).holds({50, 40}, 0));
}

// A slope of four is 0.8 mm a pixel here; the second depth is less certain than its step.
TEST(ConnectedSurface, GoesOnOverSlopesAndNoise) {
  EXPECT_TRUE(ConnectedSurface(stepped(0.7F), {40, 40}, kFocalPx, 20).holds({55, 40}, 0));
  DepthMap noisy = stepped(5);
  noisy.sigma_mm = Raster<float>(100, 80, 2.5F);
  EXPECT_TRUE(ConnectedSurface(noisy, {40, 40}, kFocalPx, 20).holds({55, 40}, 0));
}

TEST(ConnectedSurface, IsThatOfTheNearestDepthInAGap) {
  DepthMap depth = stepped(5);
  for (int u = 36; u <= 40; ++u) depth.depth_mm.at(u, 40) = kNone;
  const ConnectedSurface surface(depth, {39, 40}, kFocalPx, 20);
  ASSERT_TRUE(surface.found());
  EXPECT_FALSE(surface.holds({39, 40}, 0));
  EXPECT_TRUE(surface.holds({45, 40}, 0));
}

TEST(ConnectedSurface, IsNotFoundWithoutDepthOrPixel) {
  const DepthMap nothing{Raster<float>(100, 80, kNone), {}};
  EXPECT_FALSE(ConnectedSurface(nothing, {40, 40}, kFocalPx, 20).found());
  EXPECT_FALSE(ConnectedSurface(stepped(5), {kNone, 40}, kFocalPx, 20).found());
  const ConnectedSurface corner(stepped(0), {0, 0}, kFocalPx, 20);
  EXPECT_TRUE(corner.holds({0, 0}, 0));
  EXPECT_FALSE(corner.holds({0, 0}, 1));    // a pixel outside of the image
  EXPECT_FALSE(corner.holds({90, 40}, 0));  // out of reach
}

}  // namespace
}  // namespace softscope
