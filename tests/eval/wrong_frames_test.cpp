// tests/eval/wrong_frames_test.cpp: limits, and jumps of two points by hand.
#include "eval/motion/wrong_frames.h"

#include <gtest/gtest.h>

namespace softscope {
namespace {

constexpr double kNoPose = Statistics::kNone;

TrackError offBy(int frame, int id, const Eigen::Vector3d& offset_mm, bool visible = true,
                 bool unseen = false) {
  return {frame, id, offset_mm, 0, visible, unseen};
}

TEST(WrongFrames, EachLimitAloneMakesAFrameWrong) {
  EXPECT_FALSE(isWrong({1, 0.9, 1, 1, 1, 1}));
  EXPECT_TRUE(isWrong({1, 0.9, 1.01, 0, 0, 0}));
  EXPECT_TRUE(isWrong({1, 0.9, 0, 1.01, 0, 0}));
  EXPECT_TRUE(isWrong({1, 0.9, 0, 0, 1.01, 0}));
  EXPECT_TRUE(isWrong({1, 0.9, 0, 0, 0, 1.01}));
}

TEST(WrongFrames, WhatIsNotKnownIsNotWrong) {
  EXPECT_FALSE(isWrong({1, 0.9, kNoPose, kNoPose, kNoPose, kNoPose}));
}

TEST(WrongFrames, AWrongFrameIsSilentUnlessItsConfidenceTellsSo) {
  EXPECT_FALSE(isSilentlyWrong({1, 0.9, 0, 0, 0, 0}));
  EXPECT_FALSE(isSilentlyWrong({1, 0.5, 2, 0, 0, 0}));
  EXPECT_TRUE(isSilentlyWrong({1, 0.51, 2, 0, 0, 0}));
  EXPECT_TRUE(isSilentlyWrong({1, kNoPose, 2, 0, 0, 0}))
      << "a run that says nothing warns of nothing";
}

TEST(WrongFrames, AJumpIsTheChangeOfTheErrorAsAVector) {
  TrackErrors tracks;
  tracks.each = {offBy(3, 0, {2, 0, 0}), offBy(3, 1, {0, 0, 0}), offBy(5, 0, {0, 2, 0}),
                 offBy(5, 1, {0, 0, 1}), offBy(6, 1, {0, 0, 1})};
  const std::map<int, double> jumps_mm = largestJumps(tracks);
  EXPECT_EQ(jumps_mm.count(3), 0u) << "nothing stands before the first frame";
  EXPECT_DOUBLE_EQ(jumps_mm.at(5), std::sqrt(8.0));
  EXPECT_DOUBLE_EQ(jumps_mm.at(6), 0) << "point 0 was not reported there";
}

TEST(WrongFrames, APointOutOfSightOnEitherSideDoesNotJump) {
  TrackErrors tracks;
  tracks.each = {offBy(0, 0, {0, 0, 0}), offBy(0, 1, {0, 0, 0}), offBy(1, 0, {9, 0, 0}, false),
                 offBy(1, 1, {9, 0, 0}, true, true)};
  EXPECT_TRUE(largestJumps(tracks).empty());
}

TEST(WrongFrames, RigidTissueNeverMoves) {
  const TrueTracks rigid{{{0, 0}, {1, 2, 3}}, {{1, 0}, {1, 2, 3}}, {{1, 1}, {4, 5, 6}}};
  EXPECT_TRUE(isRigid(rigid));
  TrueTracks moving = rigid;
  moving[{2, 1}] = {4, 5, 6.01};
  EXPECT_FALSE(isRigid(moving));
}

}  // namespace
}  // namespace softscope
