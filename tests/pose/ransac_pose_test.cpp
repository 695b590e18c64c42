// tests/pose/ransac_pose_test.cpp: the right motion out of bad pairs, and an honest no.
#include "pose/ransac_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.h"

namespace softscope {
namespace {

Eigen::Isometry3d someMotion() {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -0.5).normalized()));
  motion.pretranslate(Eigen::Vector3d(4, -7, 11));
  return motion;
}

/// A curved patch of tissue 60 mm away, moved, with noise, and a share of wild outliers.
PointPairs movedPatch(int count, double outlier_share, double noise_mm, unsigned seed = 5) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> across(-20, 20), wild(-30, 30), chance(0, 1);
  std::normal_distribution<double> noise(0, 1);
  const Eigen::Isometry3d motion = someMotion();
  PointPairs pairs;
  for (int i = 0; i < count; ++i) {
    const double x = across(random), y = across(random);
    const Eigen::Vector3d p(x, y, 60 + 0.01 * (x * x + y * y));
    Eigen::Vector3d q = motion * p;
    if (chance(random) < outlier_share)
      q += Eigen::Vector3d(wild(random), wild(random), wild(random));
    q += noise_mm * Eigen::Vector3d(noise(random), noise(random), noise(random));
    pairs.sources_mm.push_back(p.cast<float>());
    pairs.targets_mm.push_back(q.cast<float>());
  }
  return pairs;
}

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return Eigen::AngleAxisd(a.linear().transpose() * b.linear()).angle();
}

TEST(RansacPose, IsExactOnExactPairs) {
  const RigidPose pose = estimateRigidPose(movedPatch(300, 0, 0), {});
  ASSERT_TRUE(pose.found) << pose.failure;
  EXPECT_EQ(pose.inliers, 300);
  EXPECT_LT(pose.rms_mm, 1e-4);  // floats at 60 mm resolve 4e-6 mm
  EXPECT_LT(angleBetween(pose.target_from_source, someMotion()), 1e-6);
  EXPECT_NEAR(pose.target_from_source.linear().determinant(), 1, 1e-12);
}

TEST(RansacPose, StandsSixtyPercentOutliers) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const RigidPose pose = estimateRigidPose(movedPatch(500, 0.6, 0.1, seed), {});
    ASSERT_TRUE(pose.found) << pose.failure;
    // 0.1 mm over 200 inliers on a 40 mm patch: 0.1 / sqrt(200) / 12 mm is 6e-4 rad.
    EXPECT_LT(angleBetween(pose.target_from_source, someMotion()), 3e-3);
    const Eigen::Vector3d centre(0, 0, 61);
    EXPECT_LT((pose.target_from_source * centre - someMotion() * centre).norm(), 0.05);
  }
}

TEST(RansacPose, StandingStillIsTheIdentity) {
  PointPairs pairs = movedPatch(100, 0, 0);
  pairs.targets_mm = pairs.sources_mm;
  const RigidPose pose = estimateRigidPose(pairs, {});
  ASSERT_TRUE(pose.found);
  EXPECT_LT(angleBetween(pose.target_from_source, Eigen::Isometry3d::Identity()), 1e-6);
}

TEST(RansacPose, WeightsTellTheGoodFromTheNoisy) {
  PointPairs pairs = movedPatch(200, 0, 0);
  for (std::size_t i = 0; i < 100; ++i) pairs.targets_mm[i].x() += 1;  // within the threshold
  pairs.weights.assign(200, 1000.0f);
  std::fill_n(pairs.weights.begin(), 100, 0.001f);
  const RigidPose pose = estimateRigidPose(pairs, {});
  ASSERT_TRUE(pose.found);
  EXPECT_LT((pose.target_from_source * Eigen::Vector3d(0, 0, 60) -
             someMotion() * Eigen::Vector3d(0, 0, 60))
                .norm(),
            1e-3);  // without weights it would be 0.5 mm
}

TEST(RansacPose, AFlatPatchIsNoMirror) {
  PointPairs pairs = movedPatch(100, 0, 0);
  for (std::size_t i = 0; i < 100; ++i) {
    pairs.sources_mm[i].z() = 60;
    pairs.targets_mm[i] = (someMotion() * pairs.sources_mm[i].cast<double>()).cast<float>();
  }
  const RigidPose pose = estimateRigidPose(pairs, {});
  ASSERT_TRUE(pose.found) << pose.failure;
  EXPECT_LT(angleBetween(pose.target_from_source, someMotion()), 1e-5);
}

TEST(RansacPose, SaysWhyItFailed) {
  EXPECT_NE(estimateRigidPose({}, {}).failure.find("0 usable pairs"), std::string::npos);

  PointPairs line;
  for (int i = 0; i < 50; ++i) line.sources_mm.push_back(Eigen::Vector3f(i, 2 * i, 60));
  line.targets_mm = line.sources_mm;
  const RigidPose on_a_line = estimateRigidPose(line, {});
  EXPECT_FALSE(on_a_line.found);
  EXPECT_NE(on_a_line.failure.find("line"), std::string::npos);

  PointPairs one_place;
  one_place.sources_mm.assign(50, Eigen::Vector3f(1, 2, 60));
  one_place.targets_mm = one_place.sources_mm;
  EXPECT_FALSE(estimateRigidPose(one_place, {}).found);

  const RigidPose chaos = estimateRigidPose(movedPatch(300, 1.0, 0), {});
  EXPECT_FALSE(chaos.found);
  EXPECT_NE(chaos.failure.find("inliers"), std::string::npos);
  EXPECT_EQ(chaos.target_from_source.matrix(), Eigen::Matrix4d::Identity());
}

TEST(RansacPose, LeavesOutWhatIsNotANumber) {
  PointPairs pairs = movedPatch(100, 0, 0);
  pairs.weights.assign(100, 1.0f);
  pairs.sources_mm[3].x() = std::numeric_limits<float>::quiet_NaN();
  pairs.targets_mm[7].z() = std::numeric_limits<float>::infinity();
  pairs.weights[9] = std::numeric_limits<float>::quiet_NaN();
  pairs.weights[11] = 0;
  const RigidPose pose = estimateRigidPose(pairs, {});
  ASSERT_TRUE(pose.found);
  EXPECT_EQ(pose.usable, 96);
  for (const std::size_t i : {3, 7, 9, 11}) EXPECT_EQ(pose.inlier[i], 0);
  EXPECT_TRUE(pose.target_from_source.matrix().allFinite());
}

TEST(RansacPose, RepeatsItself) {
  const PointPairs pairs = movedPatch(400, 0.5, 0.3);
  EXPECT_EQ(estimateRigidPose(pairs, {}).target_from_source.matrix(),
            estimateRigidPose(pairs, {}).target_from_source.matrix());
}

TEST(RansacPose, RefusesBadOptionsAndUnequalLengths) {
  RansacOptions options;
  options.threshold_mm = 0;
  EXPECT_THROW(estimateRigidPose({}, options), OptionError);
  PointPairs pairs = movedPatch(20, 0, 0);
  pairs.targets_mm.pop_back();
  EXPECT_THROW(estimateRigidPose(pairs, {}), Error);
}

}  // namespace
}  // namespace softscope
