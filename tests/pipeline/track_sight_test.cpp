// tests/pipeline/track_sight_test.cpp: visibility of tracked points, and their predicted
// sigma.
#include "pipeline/tracks/track_sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stereo/depth/relief_error.h"

namespace softscope {
namespace {

constexpr float kDepthMm = 50, kSigmaMm = 0.3f;
constexpr double kAlongMm2 = 0.02;  // variance of a tracked point in each direction of the surface

/// A wall at 50 mm with a hole of 31 x 31 pixels in the middle and a masked corner.
struct WallWithHole {
  WallWithHole() {
    rig.left = {200, 150, 500, 500, 99.5, 74.5};
    rig.baseline_mm = 5;
    frame.not_tissue = Mask(200, 150, 0);
    frame.measured.depth = {Raster<float>(200, 150, kDepthMm), Raster<float>(200, 150, kSigmaMm)};
    for (int v = 0; v < 20; ++v)
      for (int u = 0; u < 20; ++u) frame.not_tissue.at(u, v) = 255;
    for (int v = 60; v <= 90; ++v)
      for (int u = 85; u <= 115; ++u)
        frame.measured.depth.depth_mm.at(u, v) = frame.measured.depth.sigma_mm.at(u, v) =
            std::numeric_limits<float>::quiet_NaN();
  }

  Eigen::Vector3d at(double u, double v, double depth_mm) const {
    return liftPixel(rig.left, u, v, depth_mm);
  }
  TrackedPosition see(const Eigen::Vector3d& point_left, double along_mm2 = kAlongMm2,
                      double drift_mm2 = 0.01) const {
    MaterialPoints tracked;
    tracked.drift_mm2 = drift_mm2;
    tracked.points.emplace_back();
    tracked.points.back().position_mm = point_left;
    tracked.points.back().variance_mm2 = along_mm2;
    const TrackSight sight(frame, rig);
    return sight
        .positions(tracked, Eigen::Isometry3d::Identity(),
                   reliefErrorPx(frame.measured.depth.depth_mm, rig))
        .front();
  }

  RectifiedRig rig;
  FrameView frame;
};

TEST(TrackSight, SeesWhatLiesOnTheMeasuredSurface) {
  const WallWithHole wall;
  const TrackedPosition seen = wall.see(wall.at(40, 100, kDepthMm + 0.5));
  EXPECT_TRUE(seen.visible);
  EXPECT_TRUE(seen.measured);
  EXPECT_NEAR(seen.sigma_mm, std::sqrt(2 * kAlongMm2 + kSigmaMm * kSigmaMm), 1e-5);
}

TEST(TrackSight, DoesNotSeeWhatIsHiddenFloatsOrHasLeft) {
  const WallWithHole wall;
  for (const Eigen::Vector3d& point :
       {wall.at(40, 100, kDepthMm + 1.5), wall.at(40, 100, kDepthMm - 3.5),
        wall.at(10, 10, kDepthMm), wall.at(-5, 100, kDepthMm), wall.at(40, 100, -kDepthMm),
        Eigen::Vector3d(1e300, 0, 1e-300), Eigen::Vector3d(NAN, 0, 50)}) {
    const TrackedPosition seen = wall.see(point);
    EXPECT_FALSE(seen.visible) << point.transpose();
    EXPECT_FALSE(seen.measured) << point.transpose();
    EXPECT_TRUE(std::isnan(seen.sigma_mm)) << point.transpose();
  }
}

/// At the rim of the hole the surface may continue at 45 degrees.
TEST(TrackSight, InAGapIsSureOfTheSurfaceBesideItAlone) {
  const WallWithHole wall;
  const double slack_mm = 4 * kDepthMm / 500;
  const TrackedPosition seen = wall.see(wall.at(88, 75, kDepthMm));
  EXPECT_TRUE(seen.visible);
  EXPECT_FALSE(seen.measured);
  EXPECT_TRUE(wall.see(wall.at(84, 75, kDepthMm)).measured);   // 15 of its 25 pixels
  EXPECT_FALSE(wall.see(wall.at(85, 75, kDepthMm)).measured);  // 10
  EXPECT_NEAR(seen.sigma_mm, std::sqrt(2 * kAlongMm2 + kSigmaMm * kSigmaMm + slack_mm * slack_mm),
              1e-5);
  EXPECT_TRUE(wall.see(wall.at(88, 75, kDepthMm + 1 + 0.9 * slack_mm)).visible);
  EXPECT_FALSE(wall.see(wall.at(88, 75, kDepthMm + 1 + 1.1 * slack_mm)).visible);
}

TEST(TrackSight, DoesNotSeeWhatIsMeasuredWorseThanAUsedDepth) {
  WallWithHole wall;
  const Eigen::Vector3d point = wall.at(40, 100, kDepthMm);
  wall.frame.fusion.pixels.max_sigma_mm = 0.33;  // sqrt(2 x 0.02 + 0.3²) = 0.36
  EXPECT_FALSE(wall.see(point).visible);
  EXPECT_TRUE(std::isnan(wall.see(point).sigma_mm));
  wall.frame.fusion.pixels.max_sigma_mm = 0.37;
  EXPECT_TRUE(wall.see(point).visible);
}

TEST(TrackSight, DoesNotCallVisibleWhatWasNotFoundSinceItWasHidden) {
  const WallWithHole wall;
  const Eigen::Vector3d point = wall.at(40, 100, kDepthMm);
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(wall.see(point, unknown).visible);
  // With few points the error of no warp is known: it says nothing.
  EXPECT_TRUE(wall.see(point, unknown, unknown).visible);
}

TEST(TrackSight, DoesNotCallVisibleWhatNothingWasMeasuredBeside) {
  const WallWithHole wall;
  const Eigen::Vector3d middle = wall.at(100, 75, kDepthMm);
  EXPECT_FALSE(wall.see(middle).visible);
  EXPECT_TRUE(TrackSight(wall.frame, wall.rig).shows(middle));  // nothing hides it from its window
}

}  // namespace
}  // namespace softscope
