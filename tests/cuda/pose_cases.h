// tests/cuda/pose_cases.h: pairs whose poses on a device must be the CPU's.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "pose/refine_pose.h"

namespace softscope::test {

struct PoseCase {
  const char* name;
  double step_mm;       // between pairs
  double moving_share;  // of the pairs on moving tissue
  double shift_mm;      // of the scope
  bool broken = false;  // some pairs aren't finite, or behind the camera
};

inline std::vector<PoseCase> poseCases() {
  return {{"moved", 1.0, 0.3, 1.2}, {"still", 1.0, 0.2, 0},
          {"few", 5, 0, 0.4},       {"broken", 1.3, 0.1, 2, true},
          {"two", 40, 0, 0.5},      {"slow", 1.1, 0, 0.05},
          {"none", 0, 0, 0},        {"tooMany", 0.8, 0.2, 0.7}};
}

inline Eigen::Isometry3d poseOf(double turn_rad, const Eigen::Vector3d& shift_mm) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, -2, 0.5).normalized()));
  pose.pretranslate(shift_mm);
  return pose;
}

/// A hilly patch 55 mm away, part of which moves.
inline PoseQuestion poseQuestionOf(const PoseCase& of) {
  RectifiedRig rig;
  rig.left = {640, 480, 560, 560, 320, 240};
  rig.baseline_mm = 5;
  const Eigen::Isometry3d seen_from =
      poseOf(0.01 * of.shift_mm, of.shift_mm * Eigen::Vector3d(0.8, -0.5, 0.33));
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.1);
  std::vector<PosePair> pairs;
  for (double y = -18; y <= 18 && of.step_mm > 0; y += of.step_mm)
    for (double x = -24; x <= 24; x += of.step_mm) {
      PosePair pair;
      pair.model_world_mm = {x, y, 55 + 3 * std::sin(0.2 * x) * std::cos(0.15 * y)};
      pair.reference_world_mm = pair.model_world_mm + Eigen::Vector3d(0.02 * std::sin(x), 0, 0.01);
      Eigen::Vector3d moved = pair.model_world_mm;
      if (x < -24 + 48 * of.moving_share) moved += Eigen::Vector3d(0.4, 0.1 * y, -0.3);
      const Eigen::Vector3d left = seen_from.inverse() * moved;
      pair.live_px = projectPoint(rig.left, left) + Eigen::Vector2d(noise(random), noise(random));
      pair.disparity_px = rig.disparityPx(left.z()) + 3 * noise(random);
      pair.sigma_px = 0.1;
      pair.sigma_disparity_px = 0.3;
      pairs.push_back(pair);
    }
  for (std::size_t i = 0; of.broken && i + 2 < pairs.size(); i += 7) {
    pairs[i].live_px.x() = std::numeric_limits<double>::quiet_NaN();
    pairs[i + 1].reference_world_mm.z() = -60;
    pairs[i + 2].sigma_px = std::numeric_limits<double>::quiet_NaN();
  }
  const Eigen::Isometry3d rough = seen_from * poseOf(0.004, {0.2, -0.1, 0.3});
  return poseQuestion(pairs, rig, rough, Eigen::Isometry3d::Identity(), poseOf(0, {0, 0.01, 0}),
                      ScopeBefore::kMoving, RefinePoseOptions());
}

inline void expectClose(double found, double expected, double tolerance, const char* what) {
  if (std::isnan(expected))
    EXPECT_TRUE(std::isnan(found)) << what;
  else
    EXPECT_NEAR(found, expected, tolerance * std::max(1.0, std::abs(expected))) << what;
}

inline void expectSame(const PoseFindings& found, const PoseFindings& expected) {
  EXPECT_LT((found.best.translation() - expected.best.translation()).norm(), 1e-8);
  EXPECT_LT((found.best.linear() - expected.best.linear()).norm(), 1e-10);
  expectClose(found.shift, expected.shift, 1e-6, "shift");
  expectClose(found.length, expected.length, 1e-6, "length");
  expectClose(found.old_length, expected.old_length, 1e-6, "old length");
  EXPECT_EQ(found.explained, expected.explained);
  EXPECT_EQ(found.counts, expected.counts);
  EXPECT_EQ(found.score_counts, expected.score_counts);
  for (std::size_t r = 0; r < kRegions; ++r) {
    expectClose(found.gains[r], expected.gains[r], 1e-6, "gain");
    EXPECT_LT((found.normals[r] - expected.normals[r]).norm(),
              1e-6 * (1 + expected.normals[r].norm()));
    EXPECT_LT((found.scores[r] - expected.scores[r]).norm(),
              1e-6 * (1 + expected.scores[r].norm()));
  }
}

/// Equal to the CPU within rounding, and to itself to the byte.
inline void expectSame(const PoseAnswer& found, const PoseAnswer& expected) {
  expectSame(found.now, expected.now);
  expectSame(found.since, expected.since);
}

inline bool equal(const PoseFindings& a, const PoseFindings& b) {
  return a.best.matrix() == b.best.matrix() && a.normals == b.normals && a.scores == b.scores &&
         a.gains == b.gains && a.explained == b.explained && a.counts == b.counts;
}
inline bool equal(const PoseAnswer& a, const PoseAnswer& b) {
  return equal(a.now, b.now) && equal(a.since, b.since);
}

}  // namespace softscope::test
