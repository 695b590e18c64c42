// tests/pipeline/match_ahead_test.cpp: a match begun ahead is taken for its frame and viewpoint
// alone.
#include "pipeline/frame/match_ahead.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace softscope {
namespace {

/// As many matches as pixels found tell who made them.
constexpr std::size_t kBegun = 1, kMatched = 2;

struct StageInTest : MatchStage {
  ModelMatches match(const PointModel&, const Eigen::Isometry3d&, const GrayImage&,
                     const MatchPicture&, const MeasuredFrame&, StageClock*) override {
    return {std::vector<PixelMatch>(kMatched), {}};
  }
  bool begin(const PointModel&, const Eigen::Isometry3d&, const MatchPicture&,
             const MeasuredFrame&) override {
    if (fails) throw BackendError("in this test");
    return begins;
  }
  ModelMatches take(StageClock*) override { return {std::vector<PixelMatch>(kBegun), {}}; }

  bool begins = true, fails = false;
};

class MatchBegunAhead : public testing::Test {
 protected:
  MatchBegunAhead() { frame_.serial = 7; }
  std::size_t match(const FrameView& frame, const Eigen::Isometry3d& from,
                    const GrayImage& seen_gray = {}) {
    StageClock clock;
    return ahead_.match(model_, from, seen_gray, frame, &clock).pixels.size();
  }

  StageInTest* stage_ = new StageInTest;  // of ahead_
  MatchAhead ahead_{std::unique_ptr<MatchStage>(stage_)};
  PointModel model_;
  FrameView frame_;
  const Eigen::Isometry3d here_{Eigen::Translation3d(1, 2, 3)};
};

TEST_F(MatchBegunAhead, IsTakenOnce) {
  ahead_.begin(model_, here_, frame_);
  EXPECT_EQ(match(frame_, here_), kBegun);
  EXPECT_EQ(match(frame_, here_), kMatched);
}

TEST_F(MatchBegunAhead, IsOfNoUseForAnotherFrameViewpointOrRecordedImage) {
  FrameView other;
  other.serial = 8;
  ahead_.begin(model_, here_, frame_);
  EXPECT_EQ(match(other, here_), kMatched);
  EXPECT_EQ(match(frame_, here_), kMatched);
  ahead_.begin(model_, here_, frame_);
  EXPECT_EQ(match(frame_, Eigen::Isometry3d::Identity()), kMatched);
  ahead_.begin(model_, here_, frame_);
  EXPECT_EQ(match(frame_, here_, GrayImage(4, 4)), kMatched);
}

TEST_F(MatchBegunAhead, IsForgottenWithItsModel) {
  ahead_.begin(model_, here_, frame_);
  ahead_.drop();
  EXPECT_EQ(match(frame_, here_), kMatched);
}

TEST_F(MatchBegunAhead, NeedsAStageThatCan) {
  stage_->begins = false;
  ahead_.begin(model_, here_, frame_);
  EXPECT_EQ(match(frame_, here_), kMatched);
  stage_->begins = stage_->fails = true;
  EXPECT_NO_THROW(ahead_.begin(model_, here_, frame_));
  EXPECT_EQ(match(frame_, here_), kMatched);
}

}  // namespace
}  // namespace softscope
