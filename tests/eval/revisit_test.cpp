// tests/eval/revisit_test.cpp: a scope that goes away and comes back, by hand.
#include "eval/motion/revisit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace softscope {
namespace {

std::vector<Eigen::Isometry3d> along(const std::vector<double>& x_mm) {
  std::vector<Eigen::Isometry3d> poses;
  for (const double x : x_mm) poses.emplace_back(Eigen::Translation3d(x, 0, 0));
  return poses;
}

TEST(Revisits, PairsEachReturnWithTheFirstVisit) {
  // Back at 0 in frames 3 and 4; frame 1 is still near the start and no return.
  const Revisits found = revisits(along({0, 1, 5, 0.5, 0, 9}), {0.1, 0.2, 0.3, 0.4, 0.6, 0.9}, {});
  EXPECT_EQ(found.count, 2u);
  EXPECT_NEAR(found.first_mm, 0.1, 1e-12);
  EXPECT_NEAR(found.again_mm, 0.5, 1e-12);
  EXPECT_NEAR(found.growth_mm, 0.4, 1e-12);
}

TEST(Revisits, LeavesOutMomentsWithoutAnError) {
  const double none = std::nan("");
  const Revisits found = revisits(along({0, 0.2, 5, 0.4, 0}), {none, 0.2, 0.3, none, 0.6}, {});
  EXPECT_EQ(found.count, 1u);
  EXPECT_NEAR(found.growth_mm, 0.4, 1e-12);
}

TEST(Revisits, AStillOrTurnedScopeDoesNotComeBack) {
  EXPECT_EQ(revisits(along({0, 0.1, 0, 0.1, 0}), {1, 1, 1, 1, 1}, {}).count, 0u);
  auto poses = along({0, 5, 0});
  poses[2].rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()));  // 5.7 degrees
  const Revisits turned = revisits(poses, {1, 1, 1}, {});
  EXPECT_EQ(turned.count, 0u);
  EXPECT_TRUE(std::isnan(turned.growth_mm));
  EXPECT_THROW(revisits(poses, {1}, {}), OptionError);
}

}  // namespace
}  // namespace softscope
