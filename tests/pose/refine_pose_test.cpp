// tests/pose/refine_pose_test.cpp: pixels pin the pose, moving tissue doesn't, a static scope stays
// and a slow one is found.
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
                               double noise_px = 0, unsigned seed = 7) {
  const RectifiedRig rig = someRig();
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  std::vector<PosePair> pairs;
  for (double y = -18; y <= 18; y += 1.5)
    for (double x = -24; x <= 24; x += 1.5) {
      PosePair pair;
      pair.model_world_mm = {x, y, 55 + 3 * std::sin(0.2 * x) * std::cos(0.15 * y)};
      pair.reference_world_mm = pair.model_world_mm;
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

/// With the previous pose as the reference.
RefinedPose refined(const std::vector<PosePair>& pairs, const Eigen::Isometry3d& fitted,
                    const Eigen::Isometry3d& last, const RefinePoseOptions& options = {},
                    ScopeBefore before = ScopeBefore::kStatic) {
  return refinePose(pairs, someRig(), fitted, last, last, before, options);
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
  const RefinedPose found = refined(seenFrom(truth, nothing), poseOf(0.05, {2, -2, 3}),
                                    poseOf(0.06, {3, -1, 3}), options);
  expectNear(found.world_from_left, truth, 1e-6, 1e-8);
  EXPECT_FALSE(found.scope_static);
}

// 0.1 px over 800 matches: a hundredth of a pixel, 1e-3 mm at 55 mm, some times that in pose.
TEST(RefinePose, AveragesNoiseAway) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  const RefinedPose found = refined(seenFrom(truth, nothing, 0.1), poseOf(0.09, {4, -2, 5}),
                                    Eigen::Isometry3d::Identity());
  expectNear(found.world_from_left, truth, 0.05, 1e-3);
}

/// Mean square error of the position over mean square of its prediction, over many samples.
double errorOverPrediction(double noise_px, double claimed_px, bool (*is_kept)(const PosePair&)) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  double error_sq = 0, sigma_sq = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::vector<PosePair> pairs;
    for (PosePair pair : seenFrom(truth, nothing, noise_px, seed)) {
      pair.sigma_px = claimed_px;
      pair.sigma_disparity_px = 5 * claimed_px;
      if (is_kept(pair)) pairs.push_back(pair);
    }
    const RefinedPose found =
        refined(pairs, poseOf(0.09, {4, -2, 5}), Eigen::Isometry3d::Identity());
    error_sq += (found.world_from_left.translation() - truth.translation()).squaredNorm();
    sigma_sq += found.sigma_mm * found.sigma_mm;
  }
  return error_sq / sigma_sq;
}

// To a factor of 1.5 either way; 24 regions give a variance to 30 %.
TEST(RefinePose, PredictsItsError) {
  const auto all = [](const PosePair&) { return true; };
  const double ratio = errorOverPrediction(0.1, 0.1, all);
  EXPECT_GT(ratio, 1 / 2.25);
  EXPECT_LT(ratio, 2.25);
}

// Large residuals have a small weight, and say even less than that.
TEST(RefinePose, PredictsTheErrorOfMatchesThatClaimTooLittle) {
  const auto all = [](const PosePair&) { return true; };
  const double ratio = errorOverPrediction(0.5, 0.1, all);
  EXPECT_GT(ratio, 1 / 2.25);
  EXPECT_LT(ratio, 2.25);
}

// What few matches decide leaves no residual there.
TEST(RefinePose, PredictsItsErrorWhereFewMatchesDecide) {
  const auto mostly_left = [](const PosePair& pair) {
    return pair.live_px.x() < 240 || (pair.live_px.x() > 560 && pair.live_px.y() < 90);
  };
  const double ratio = errorOverPrediction(0.1, 0.1, mostly_left);
  EXPECT_GT(ratio, 1 / 2.25);
  EXPECT_LT(ratio, 2.25);
}

// A third of the tissue is pulled by up to 2 mm while the scope moves: least squares would be off
// by a good part of that.
TEST(RefinePose, TakesTheWordOfTheTissueThatKeepsStill) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  const auto pulled = [](const Eigen::Vector3d& p) {
    return p.x() > 8 ? Eigen::Vector3d(0.12 * (p.x() - 8), 0.5, -1) : Eigen::Vector3d(0, 0, 0);
  };
  const RefinedPose found = refined(seenFrom(truth, pulled, 0.05), poseOf(0.09, {4, -2, 5}),
                                    Eigen::Isometry3d::Identity());
  expectNear(found.world_from_left, truth, 0.1, 2e-3);
}

TEST(RefinePose, AStaticScopeBeforeTissueThatBendsStaysExactly) {
  const Eigen::Isometry3d last = poseOf(0.2, {1, 2, 3});
  const auto wave = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.5 * std::sin(0.3 * p.y()), 0.5 * std::sin(0.3 * p.x()), 0);
  };
  const std::vector<PosePair> pairs = seenFrom(last, wave, 0.05);
  const Eigen::Isometry3d fitted = last * poseOf(0.01, {0.3, 0.2, 0.5});
  const RefinedPose found = refined(pairs, fitted, last);
  EXPECT_TRUE(found.scope_static);
  EXPECT_EQ(found.world_from_left.matrix(), last.matrix());
  EXPECT_GT(found.moved_mm, 0);  // measured all the same

  RefinePoseOptions moving;
  moving.scope = "moving";
  EXPECT_FALSE(refined(pairs, fitted, last, moving).scope_static);
}

/// A scope that creeps by `step_mm` a frame while the warp takes every step for tissue.
std::vector<PosePair> creepingPairs(int frame, double step_mm, double noise_px) {
  const Eigen::Isometry3d truth = poseOf(0, {frame * step_mm, 0, 0});
  std::vector<PosePair> pairs = seenFrom(truth, nothing, noise_px);
  for (PosePair& pair : pairs)  // the static camera sees the tissue go the other way
    pair.model_world_mm -= Eigen::Vector3d((frame - 1) * step_mm, 0, 0);
  return pairs;
}

// 0.02 mm is a fifth of a pixel, less than the match errors; no single frame shows it.
TEST(RefinePose, FindsASlowMotionOnceItHasAddedUp) {
  const Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  constexpr double kStepMm = 0.02;
  EXPECT_TRUE(refined(creepingPairs(1, kStepMm, 0.18), start, start).scope_static);
  int frame = 2;
  while (frame < 40 && refined(creepingPairs(frame, kStepMm, 0.18), start, start).scope_static)
    ++frame;
  ASSERT_LT(frame, 10);  // 0.2 mm: six standard errors of a match are 0.12 mm
  const RefinedPose found = refined(creepingPairs(frame, kStepMm, 0.18), start, start);
  EXPECT_NEAR(found.world_from_left.translation().x(), frame * kStepMm, 0.02);  // all of it
  EXPECT_NEAR(found.moved_mm, frame * kStepMm, 0.05);
}

// Half a dozen standard errors in the reference shape, though no pair sees it.
TEST(RefinePose, AScopeAtRestMovesOnceItsPositionIsManyStandardErrorsAway) {
  const Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  const RefinedPose little = refined(creepingPairs(2, 0.02, 0.1), start, start);
  EXPECT_LT(little.moved_mm, 5 * little.sigma_mm);
  EXPECT_TRUE(little.scope_static);
  RefinedPose more;
  int frame = 3;
  do more = refined(creepingPairs(frame++, 0.02, 0.1), start, start);
  while (more.scope_static && frame < 40);
  EXPECT_GT(more.moved_mm, 5 * more.sigma_mm);
  EXPECT_LT(more.moved_mm, 0.1);  // single pairs see it one frame later
  EXPECT_TRUE(more.keeps_shape);
}

// Below the error of a single match, but not below that of all of them.
TEST(RefinePose, MeasuresAMotionOverRigidTissueThatNoSinglePairSees) {
  const Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
  const RefinedPose found = refined(creepingPairs(4, 0.02, 0.18), start, start);
  EXPECT_TRUE(found.scope_static);
  EXPECT_NEAR(found.world_from_left.translation().x(), 0.08, 0.02);
}

// A model that each frame's error has turned a little: the reference shape has none of it.
TEST(RefinePose, MeasuresARigidSceneInItsReferenceShape) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5}), drift = poseOf(0.002, {0.05, 0, 0});
  std::vector<PosePair> pairs = seenFrom(truth, nothing, 0.02);
  for (PosePair& pair : pairs) pair.model_world_mm = drift * pair.model_world_mm;
  const RefinedPose found = refined(pairs, truth, Eigen::Isometry3d::Identity());
  EXPECT_TRUE(found.keeps_shape);
  expectNear(found.world_from_left, truth, 0.02, 4e-4);
}

// Pulled aside by 6 mm and bent over many frames, before a scope at rest: it stays where it was
// last.
TEST(RefinePose, TissuePulledAsAWholeIsNoSlowMotionOfTheScope) {
  const Eigen::Isometry3d last = poseOf(1e-4, {0.01, 0, 0.02});
  std::vector<PosePair> pairs = seenFrom(last, nothing, 0.02);
  for (PosePair& pair : pairs)
    pair.reference_world_mm += Eigen::Vector3d(6 + 0.8 * std::sin(0.3 * pair.model_world_mm.y()), 0,
                                               std::cos(0.3 * pair.model_world_mm.x()));
  const RefinedPose found = refinePose(pairs, someRig(), last, last, Eigen::Isometry3d::Identity(),
                                       ScopeBefore::kStatic, {});
  EXPECT_TRUE(found.scope_static);
  EXPECT_EQ(found.world_from_left.matrix(), last.matrix());
}

// A quarter of the tissue begins to move before a scope at rest: the pose does not follow at once.
TEST(RefinePose, TissueThatBeginsToMoveHardlyMovesAScopeAtRest) {
  const Eigen::Isometry3d last = Eigen::Isometry3d::Identity();
  std::vector<PosePair> pairs = seenFrom(last, nothing, 0.02);
  for (std::size_t i = 0; i < pairs.size() / 4; ++i) pairs[i].reference_world_mm.x() -= 0.3;
  const RefinedPose found =
      refinePose(pairs, someRig(), last, last, last, ScopeBefore::kStatic, {});
  EXPECT_TRUE(found.scope_static);
  EXPECT_GT(found.moved_mm, 0.001);
  EXPECT_LT(found.world_from_left.translation().norm(), 0.3 * found.moved_mm);
}

TEST(RefinePose, TakesThePresentShapeOfTissueThatHasBent) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  std::vector<PosePair> pairs = seenFrom(truth, nothing, 0.02);
  for (PosePair& pair : pairs)
    pair.reference_world_mm += Eigen::Vector3d(0.5 * std::sin(0.3 * pair.model_world_mm.y()), 0,
                                               0.8 * std::cos(0.3 * pair.model_world_mm.x()));
  const RefinedPose found = refined(pairs, truth, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(found.keeps_shape);
  expectNear(found.world_from_left, truth, 0.02, 4e-4);
}

/// Tissue that bends while the scope moves a little: about 40 % of the residuals are left.
std::vector<PosePair> pairsOfAScopeThatSlowsDown() {
  const auto bent = [](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(0.09 * std::sin(0.6 * p.y()), 0.09 * std::sin(0.6 * p.x()), 0);
  };
  return seenFrom(poseOf(0.001, {0.2, 0.15, 0}), bent, 0.1);
}

// At rest before, it may be tissue that is pulled; a scope that moved has hardly stopped at once.
TEST(RefinePose, AScopeThatMovedStillMovesBeforeTissueThatBends) {
  const std::vector<PosePair> pairs = pairsOfAScopeThatSlowsDown();
  const Eigen::Isometry3d last = Eigen::Isometry3d::Identity(), fitted = poseOf(0, {0.2, 0.1, 0});
  EXPECT_TRUE(refined(pairs, fitted, last, {}, ScopeBefore::kStatic).scope_static);
  EXPECT_FALSE(refined(pairs, fitted, last, {}, ScopeBefore::kMoving).scope_static);
}

TEST(RefinePose, AScopeThatStopsIsStaticAlsoAfterAMotion) {
  const Eigen::Isometry3d pose = poseOf(0.2, {1, 2, 3});
  const std::vector<PosePair> pairs = seenFrom(pose, nothing, 0.3);
  const Eigen::Isometry3d fitted = pose * poseOf(0.001, {0, 0.1, 0});
  EXPECT_TRUE(refined(pairs, fitted, pose, {}, ScopeBefore::kMoving).scope_static);
  EXPECT_FALSE(refined(pairs, fitted, pose, {}, ScopeBefore::kUnclear).scope_static);
}

TEST(RefinePose, AStaticScopeIsNotTakenForMovingByNoise) {
  const Eigen::Isometry3d pose = poseOf(0.2, {1, 2, 3});
  EXPECT_TRUE(
      refined(seenFrom(pose, nothing, 0.3), pose * poseOf(0.001, {0, 0.1, 0}), pose).scope_static);
}

// A motion that all tissue shares is significant as soon as single pairs see it.
TEST(RefinePose, FollowsASlowScopeThroughNoise) {
  const Eigen::Isometry3d last = poseOf(0.2, {1, 2, 3});
  const Eigen::Isometry3d truth = last * poseOf(0.001, {0.2, 0.1, 0});
  const RefinedPose found =
      refined(seenFrom(truth, nothing, 0.18), last * poseOf(0.002, {0.2, 0, 0.1}), last);
  EXPECT_FALSE(found.scope_static);
  // 0.18 px is 0.02 mm a match; across the rays it averages out, turn and shift trade places.
  EXPECT_LT((someRig().left.fx_px / 55 *
             ((found.world_from_left.inverse() * Eigen::Vector3d(0, 0, 55)) -
              (truth.inverse() * Eigen::Vector3d(0, 0, 55)))
                 .head<2>()
                 .norm()),
            0.1);
}

TEST(RefinePose, FollowsTheUsersWordThatTheScopeIsStatic) {
  const Eigen::Isometry3d last = poseOf(0.2, {1, 2, 3});
  RefinePoseOptions options;
  options.scope = "static";
  const RefinedPose found =
      refined(seenFrom(last * poseOf(0.05, {3, 0, 0}), nothing), last, last, options);
  EXPECT_TRUE(found.scope_static);
  EXPECT_EQ(found.world_from_left.matrix(), last.matrix());
  EXPECT_GT(found.moved_mm, 2);
}

// After a loss only a part of the image shows tissue of the model.
TEST(RefinePose, FindsAMotionThatHalfOfTheImageSees) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  std::vector<PosePair> pairs;
  for (const PosePair& pair : seenFrom(truth, nothing, 0.05))
    if (pair.live_px.x() > 400 && pair.live_px.y() > 200) pairs.push_back(pair);
  ASSERT_GT(pairs.size(), 50u);
  const RefinedPose found = refined(pairs, poseOf(0.09, {4, -2, 5}), Eigen::Isometry3d::Identity());
  EXPECT_FALSE(found.scope_static);
  EXPECT_TRUE(std::isfinite(found.sigma_mm));
  expectNear(found.world_from_left, truth, 0.3, 5e-3);
}

/// A fifth of the image is wide enough to distinguish a rotation from a shift.
TEST(RefinePose, FindsTheMotionBeforeASmallOrgan) {
  const Eigen::Isometry3d truth = poseOf(0.05, {2, -1.5, 1});
  std::vector<PosePair> pairs;
  for (const PosePair& pair : seenFrom(truth, nothing, 0.05)) {
    const Eigen::Vector3d& place_mm = pair.model_world_mm;
    if (std::abs(place_mm.x()) < 6 && std::abs(place_mm.y()) < 6) pairs.push_back(pair);
  }
  ASSERT_GT(pairs.size(), 40u);
  const RefinedPose found = refined(pairs, truth, Eigen::Isometry3d::Identity());
  EXPECT_FALSE(found.scope_static);
  EXPECT_LT(found.sigma_deg, 1);
  const Eigen::Vector3d error_mm = found.world_from_left.translation() - truth.translation();
  EXPECT_LT(error_mm.norm(), 4 * found.sigma_mm);
}

// Pairs in one corner do not distinguish a rotation from a shift.
TEST(RefinePose, KnowsNoErrorWherePairsLieTooCloseTogether) {
  std::vector<PosePair> corner;
  for (const PosePair& pair : seenFrom(Eigen::Isometry3d::Identity(), nothing))
    if (pair.live_px.x() < 160 && pair.live_px.y() < 120) corner.push_back(pair);
  ASSERT_GT(corner.size(), 20u);
  const RefinedPose found =
      refined(corner, poseOf(0.01, {0.1, 0, 0}), Eigen::Isometry3d::Identity());
  EXPECT_TRUE(std::isnan(found.sigma_mm));
}

TEST(RefinePose, InvalidPairsHaveNoEffect) {
  const Eigen::Isometry3d truth = poseOf(0.1, {4, -3, 5});
  std::vector<PosePair> pairs = seenFrom(truth, nothing);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  pairs[3].live_px.x() = nan;
  pairs[5].disparity_px = nan;
  pairs[7].sigma_px = nan;
  pairs[9].model_world_mm.z() = -100;
  const RefinedPose found = refined(pairs, poseOf(0.09, {4, -2, 5}), Eigen::Isometry3d::Identity());
  expectNear(found.world_from_left, truth, 1e-6, 1e-8);
  RefinePoseOptions moving;
  moving.scope = "moving";
  const Eigen::Isometry3d fitted = poseOf(0.3, {1, 1, 1});
  expectNear(refined({}, fitted, truth, moving).world_from_left, fitted, 1e-12, 1e-7);
}

TEST(RefinePose, RefusesBadOptions) {
  RefinePoseOptions options;
  options.scope = "still";
  EXPECT_THROW(refined({}, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), options),
               OptionError);
  options.scope = "auto";
  options.iterations = -1;
  EXPECT_THROW(refined({}, Eigen::Isometry3d::Identity(), Eigen::Isometry3d::Identity(), options),
               OptionError);
}

}  // namespace
}  // namespace softscope
