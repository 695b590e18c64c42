// tests/pose/refine_pose_test.cpp: pixels pin the pose, moving tissue doesn't, and a still scope
// stays.
#include "pose/refine_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/error.h"

namespace softscope {
namespace {

RectifiedRig someRig() {
  RectifiedRig rig;
  rig.left = {640, 480, 560, 560, 320, 240};
  rig.baseline_mm = 5;
  return rig;
}

Eigen::Isometry3d poseOf(double turn_rad, const Eigen::Vector3d& shift_mm) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, -2, 0.5).normalized()));
  pose.pretranslate(shift_mm);
  return pose;
}

using Motion = std::function<Eigen::Vector3d(const Eigen::Vector3d& model_world_mm)>;

/// A hilly patch 55 mm away; `motion` moves the tissue itself, in the world, before it is seen.
std::vector<PosePair> seenFrom(const Eigen::Isometry3d& world_from_left, const Motion& motion,
                               double noise_px = 0) {
  const RectifiedRig rig = someRig();
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  std::vector<PosePair> pairs;
  for (double y = -18; y <= 18; y += 1.5)
    for (double x = -24; x <= 24; x += 1.5) {
      PosePair pair;
      pair.model_world_mm = {x, y, 55 + 3 * std::sin(0.2 * x) * std::cos(0.15 * y)};
      const Eigen::Vector3d left =
          world_from_left.inverse() * (pair.model_world_mm + motion(pair.model_world_mm));
      pair.live_px =
          projectPoint(rig.left, left) + noise_px * Eigen::Vector2d(noise(random), noise(random));
      pair.disparity_px = rig.disparityPx(left.z()) + 5 * noise_px * noise(random);
      pair.sigma_px = noise_px;
      pair.sigma_disparity_px = 5 * noise_px;
      pairs.push_back(pair);
    }
  return pairs;
}

Eigen::Vector3d nothing(const Eigen::Vector3d&) { return Eigen::Vector3d::Zero(); }

void expectNear(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double mm, double rad) {
  EXPECT_LT((a.translation() - b.translation()).norm(), mm);
  EXPECT_LT(Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle(), rad);
}

// Slopes that are wrong would not lead there, nor so fast.
TEST(RefinePose, FindsAnExactPoseFromThreeDegreesAway) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  RefinePoseOptions options;
  options.iterations = 8;
  const RefinedPose found = refinePose(seenFrom(truth, nothing), someRig(),
                                       poseOf(0.05, {2, -2, 3}), poseOf(0.06, {3, -1, 3}), options);
  expectNear(found.world_from_left, truth, 1e-6, 1e-8);
  EXPECT_FALSE(found.stands);
}

// 0.1 px over 800 matches: a hundredth of a pixel, 1e-3 mm at 55 mm, some times that in pose.
TEST(RefinePose, AveragesNoiseAway) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  const RefinedPose found =
      refinePose(seenFrom(truth, nothing, 0.1), someRig(), poseOf(0.09, {4, -2, 5}),
                 Eigen::Isometry3d::Identity(), RefinePoseOptions());
  expectNear(found.world_from_left, truth, 0.05, 1e-3);
}

// A third of the tissue is pulled by up to 2 mm while the scope moves: least squares would be off
// by a good part of that.
TEST(RefinePose, TakesTheWordOfTheTissueThatKeepsStill) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  const auto pulled = [](const Eigen::Vector3d& p) {
    return p.x() > 8 ? Eigen::Vector3d(0.12 * (p.x() - 8), 0.5, -1) : Eigen::Vector3d(0, 0, 0);
  };
  const RefinedPose found =
      refinePose(seenFrom(truth, pulled, 0.05), someRig(), poseOf(0.09, {4, -2, 5}),
                 Eigen::Isometry3d::Identity(), RefinePoseOptions());
  expectNear(found.world_from_left, truth, 0.1, 2e-3);
}

TEST(RefinePose, AStillScopeBeforeTissueThatBendsStaysExactly) {
  const Eigen::Isometry3d last = poseOf(0.2, {1, 2, 3});
  const auto wave = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.5 * std::sin(0.3 * p.y()), 0.5 * std::sin(0.3 * p.x()), 0);
  };
  const RefinedPose found =
      refinePose(seenFrom(last, wave, 0.05), someRig(), last * poseOf(0.01, {0.3, 0.2, 0.5}), last,
                 RefinePoseOptions());
  EXPECT_TRUE(found.stands);
  EXPECT_EQ(found.world_from_left.matrix(), last.matrix());
  EXPECT_GT(found.moved_mm, 0.2);
}

// A tenth of a millimetre a frame is not much more than matching's noise, but all tissue shares it.
TEST(RefinePose, FollowsASlowScopeThroughNoise) {
  const Eigen::Isometry3d last = poseOf(0.2, {1, 2, 3});
  const Eigen::Isometry3d truth = last * poseOf(0.001, {0.1, 0.05, 0});
  const RefinedPose found =
      refinePose(seenFrom(truth, nothing, 0.18), someRig(), last * poseOf(0.002, {0.2, 0, 0.1}),
                 last, RefinePoseOptions());
  EXPECT_GT(found.left_mm, 0.15 * found.moved_mm);  // so (29) alone would keep it
  EXPECT_FALSE(found.stands);
  // 0.18 px is 0.02 mm a match; across the rays it averages out, turn and shift trade places.
  EXPECT_LT((someRig().left.fx_px / 55 *
             ((found.world_from_left.inverse() * Eigen::Vector3d(0, 0, 55)) -
              (truth.inverse() * Eigen::Vector3d(0, 0, 55)))
                 .head<2>()
                 .norm()),
            0.1);
}

// What depth measures too far together is told while the scope stands, and not taken for motion.
TEST(RefinePose, TellsAnOffsetOfTheDisparities) {
  const auto wave = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.3 * std::sin(0.3 * p.y()), 0.3 * std::sin(0.3 * p.x()), 0);
  };
  std::vector<PosePair> pairs = seenFrom(Eigen::Isometry3d::Identity(), wave);
  for (PosePair& pair : pairs) pair.disparity_px += 0.4;
  const RefinedPose found = refinePose(pairs, someRig(), Eigen::Isometry3d::Identity(),
                                       Eigen::Isometry3d::Identity(), RefinePoseOptions());
  ASSERT_TRUE(found.stands);
  EXPECT_NEAR(found.disparity_offset_px, 0.4, 0.02);
}

TEST(RefinePose, BadPairsHaveNoSay) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  std::vector<PosePair> pairs = seenFrom(truth, nothing);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  pairs[3].live_px.x() = nan;
  pairs[5].disparity_px = nan;
  pairs[7].sigma_px = nan;
  pairs[9].model_world_mm.z() = -100;
  const RefinedPose found = refinePose(pairs, someRig(), poseOf(0.09, {4, -2, 5}),
                                       Eigen::Isometry3d::Identity(), RefinePoseOptions());
  expectNear(found.world_from_left, truth, 1e-6, 1e-8);
  const Eigen::Isometry3d fitted = poseOf(0.3, {1, 1, 1});
  expectNear(refinePose({}, someRig(), fitted, truth, RefinePoseOptions()).world_from_left, fitted,
             1e-12, 1e-7);
}

TEST(RefinePose, RefusesBadOptions) {
  RefinePoseOptions options;
  options.standing_share = 2;
  EXPECT_THROW(refinePose({}, someRig(), Eigen::Isometry3d::Identity(),
                          Eigen::Isometry3d::Identity(), options),
               OptionError);
}

}  // namespace
}  // namespace softscope
