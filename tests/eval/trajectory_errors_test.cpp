// tests/eval/trajectory_errors_test.cpp: paths whose errors are known in closed form.
#include "eval/motion/trajectory_errors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

constexpr double kLengthRounding = 1e-9;  // double, lengths of some 100 mm
using Poses = std::vector<Eigen::Isometry3d>;

Eigen::Isometry3d pose(const Eigen::Vector3d& translation_mm, double angle_deg = 0,
                       const Eigen::Vector3d& axis = {0, 0, 1}) {
  Eigen::Isometry3d p = Eigen::Isometry3d::Identity();
  p.linear() = Eigen::AngleAxisd(angle_deg * M_PI / 180, axis.normalized()).toRotationMatrix();
  p.translation() = translation_mm;
  return p;
}

/// A helix that turns as it goes.
Poses helix(int count) {
  Poses poses;
  for (int i = 0; i < count; ++i) {
    const double t = 0.3 * i;
    poses.push_back(pose({20 * std::cos(t), 20 * std::sin(t), 2.0 * i}, 5.0 * i, {1, 2, 3}));
  }
  return poses;
}

TEST(TrajectoryErrors, AnotherWorldIsAlignedAwayButSeenBefore) {
  const Poses truth = helix(20);
  const Eigen::Isometry3d moved = pose({3, -4, 12}, 30, {1, 1, 0});
  Poses estimate;
  for (const auto& p : truth) estimate.push_back(moved * p);

  const TrajectoryErrors errors = trajectoryErrors(truth, estimate);

  EXPECT_TRUE(errors.alignment_unique);
  EXPECT_LT(errors.absolute.translation_mm.max, kLengthRounding);
  EXPECT_LT(errors.absolute.rotation_deg.max, 1e-6);
  EXPECT_LT(errors.relative.translation_mm.max, kLengthRounding);
  EXPECT_TRUE(errors.truth_from_estimate.isApprox(moved.inverse(), 1e-9));
  EXPECT_NEAR(errors.unaligned.rotation_deg.mean, 30, 1e-9);
  EXPECT_GT(errors.unaligned.translation_mm.mean, 10);
}

TEST(TrajectoryErrors, AShiftOfOnePoseIsTwoWrongStepsAndOneWrongPose) {
  const Poses truth(10, Eigen::Isometry3d::Identity());
  Poses estimate = truth;
  estimate[4].translation() = Eigen::Vector3d(0, 3, 4);

  const TrajectoryErrors errors = trajectoryErrors(truth, estimate);

  EXPECT_NEAR(errors.unaligned.each_mm[4], 5, kLengthRounding);
  EXPECT_NEAR(errors.unaligned.translation_mm.rmse, 5 / std::sqrt(10.0), kLengthRounding);
  ASSERT_EQ(errors.relative.each_mm.size(), 9u);
  EXPECT_NEAR(errors.relative.each_mm[3], 5, kLengthRounding);
  EXPECT_NEAR(errors.relative.each_mm[4], 5, kLengthRounding);
  EXPECT_NEAR(errors.relative.translation_mm.mean, 10.0 / 9, kLengthRounding);
  // A still truth is met best by the mean of the positions: a spread of 5 * sqrt(0.1 * 0.9).
  EXPECT_NEAR(errors.absolute.translation_mm.rmse, 5 * std::sqrt(0.09), kLengthRounding);
  EXPECT_FALSE(errors.alignment_unique);
  EXPECT_TRUE(std::isnan(errors.absolute.rotation_deg.mean));
}

TEST(TrajectoryErrors, ASquareOfAnotherSizeHasTheErrorOfItsCorners) {
  Poses truth, estimate;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0),
                                        Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, -1, 0)}) {
    truth.push_back(pose(10 * corner));
    estimate.push_back(pose(11 * corner + Eigen::Vector3d(7, 8, 9)));
  }
  const TrajectoryErrors errors = trajectoryErrors(truth, estimate);
  // No scale is estimated: each corner stays 1 mm off, each side sqrt(2) mm.
  EXPECT_NEAR(errors.absolute.translation_mm.rmse, 1, kLengthRounding);
  EXPECT_NEAR(errors.absolute.translation_mm.max, 1, kLengthRounding);
  EXPECT_NEAR(errors.relative.translation_mm.rmse, std::sqrt(2), kLengthRounding);
}

TEST(TrajectoryErrors, ADriftThatTurnsIsAConstantStepError) {
  const Poses truth = helix(50);
  Poses estimate{truth[0]};
  const Eigen::Isometry3d wrong = pose({0.1, 0, 0}, 0.2, {0, 1, 0});
  for (std::size_t i = 1; i < truth.size(); ++i)
    estimate.push_back(estimate.back() * (truth[i - 1].inverse() * truth[i]) * wrong);
  const TrajectoryErrors errors = trajectoryErrors(truth, estimate);
  EXPECT_NEAR(errors.relative.translation_mm.median, 0.1, kLengthRounding);
  EXPECT_NEAR(errors.relative.translation_mm.sd, 0, kLengthRounding);
  EXPECT_NEAR(errors.relative.rotation_deg.mean, 0.2, 1e-6);
}

TEST(TrajectoryErrors, AStepOverMomentsThatWereLeftOutIsNone) {
  const Poses truth = helix(4);
  const TrajectoryErrors errors = trajectoryErrors(truth, truth, {0, 1, 5, 6});
  ASSERT_EQ(errors.relative.each_mm.size(), 3u);
  EXPECT_TRUE(std::isnan(errors.relative.each_mm[1])) << "from moment 1 to 5";
  EXPECT_EQ(errors.relative.translation_mm.count, 2u);
  EXPECT_EQ(errors.relative_scaled.translation_mm.count, 2u);
  EXPECT_THROW(trajectoryErrors(truth, truth, {0, 1}), InputError);
}

TEST(TrajectoryErrors, HalfATurnIs180Degrees) {
  const TrajectoryErrors errors =
      trajectoryErrors({Eigen::Isometry3d::Identity()}, {pose({0, 0, 0}, 180)});
  EXPECT_NEAR(errors.unaligned.rotation_deg.mean, 180, 1e-6);
  EXPECT_EQ(errors.relative.translation_mm.count, 0u);
}

TEST(TrajectoryErrors, UnequalEmptyAndBrokenPathsAreRefused) {
  EXPECT_THROW(trajectoryErrors(helix(3), helix(4)), InputError);
  EXPECT_THROW(trajectoryErrors({}, {}), InputError);
  Poses broken = helix(3);
  broken[1].translation().x() = std::nan("");
  EXPECT_THROW(trajectoryErrors(helix(3), broken), InputError);
}

}  // namespace
}  // namespace softscope
