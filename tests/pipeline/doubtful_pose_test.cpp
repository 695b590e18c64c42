// tests/pipeline/doubtful_pose_test.cpp: matches that agree on a pose which the images contradict.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/cpu_backend.h"
#include "pipeline/reconstructor.h"
#include "short_clip.h"

namespace softscope::test {
namespace {

using Misled = void (*)(ModelMatches* matches);

/// The tissue would lie 8 mm aside.
void setAside(ModelMatches* matches) {
  for (LiftedMatch& match : matches->lifted) match.target_left_mm.x() += 8;
}

/// What lies about one place of the tissue is all that is matched.
void keepOnePlace(ModelMatches* matches) {
  const std::vector<LiftedMatch> all = matches->lifted;
  const Eigen::Vector3f centre = all[all.size() / 2].target_left_mm;
  std::vector<LiftedMatch>& kept = matches->lifted;
  kept.clear();
  for (const LiftedMatch& match : all)
    if ((match.target_left_mm - centre).norm() < 3) kept.push_back(match);
}

/// Of the matches of the first calls, what is left of them.
class MisledMatches : public MatchStage {
 public:
  MisledMatches(std::unique_ptr<MatchStage> stage, Misled mislead, int* until, int* calls)
      : stage_(std::move(stage)), mislead_(mislead), until_(until), calls_(calls) {}
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override {
    ModelMatches found = stage_->match(model, viewed_from, seen_gray, live, frame, clock);
    if (++*calls_ <= *until_) mislead_(&found);
    return found;
  }

 private:
  std::unique_ptr<MatchStage> stage_;
  Misled mislead_;
  int *until_, *calls_;
};

/// A clip, of which the matches of all calls up to one mislead.
struct MisledRun {
  MisledRun(Misled mislead, int misled_calls) : until(misled_calls) {
    const ReconstructionOptions options = smallOptions();
    BackendParts parts;
    parts.makeMatching = [this, mislead](const ReconstructionOptions& all,
                                         const RectifiedRig& rig) {
      return std::make_unique<MisledMatches>(makeCpuMatchStage(all, rig), mislead, &until, &calls);
    };
    reconstructor = std::make_unique<Reconstructor>(
        makeCpuBackend(shortClip().calibration, options, parts), options);
    reconstructor->track(shortClip().seeds);
    reconstructor->process(shortClip().frames[0]);
  }

  int until, calls = 0;
  std::unique_ptr<Reconstructor> reconstructor;
};

TEST(DoubtfulPose, IsSoughtInTheWholeImageInTheSameFrame) {
  const ShortClip& clip = shortClip();
  MisledRun run(setAside, 1);
  const FrameRecord record = run.reconstructor->process(clip.frames[1]);
  EXPECT_EQ(run.calls, 2);
  ASSERT_EQ(record.status, FrameStatus::kRecovered) << record.reason;
  EXPECT_LT(trackErrorMm(record, clip.truth[1]), 0.5);
  EXPECT_EQ(run.reconstructor->process(clip.frames[2]).status, FrameStatus::kFused);
}

// Where it is found nowhere else, the frame changes nothing, and is told as what it is.
TEST(DoubtfulPose, LeavesModelAndPoseAsTheyWere) {
  const ShortClip& clip = shortClip();
  MisledRun run(setAside, 2);
  const std::string before = bytesOf(run.reconstructor->model().model);
  const FrameRecord record = run.reconstructor->process(clip.frames[1]);
  EXPECT_EQ(run.calls, 2);
  ASSERT_EQ(record.status, FrameStatus::kUnconfirmed) << record.reason;
  EXPECT_TRUE(record.world_from_left.isApprox(Eigen::Isometry3d::Identity()));
  PointModel after = run.reconstructor->model().model;
  for (PointBinding& binding : after.bindings) binding = {};  // the graph may grow
  EXPECT_TRUE(before == bytesOf(after));
  const FrameRecord next = run.reconstructor->process(clip.frames[2]);
  EXPECT_EQ(next.status, FrameStatus::kFused) << next.reason;
  EXPECT_EQ(run.calls, 3) << "sought from the last pose";
}

void dropAll(ModelMatches* matches) { matches->lifted.clear(); }

/// What both cameras see, this much lower in the image.
Frame lowered(Frame frame, int rows_px) {
  for (ColourImage* image : {&frame.pair.left, &frame.pair.right})
    std::copy_backward(image->values.begin(), image->values.end() - rows_px * image->width_px,
                       image->values.end());
  return frame;
}

// Matches side by side agree with any rotation about them.
TEST(DoubtfulPose, IsOneThatTheMatchesDoNotDetermine) {
  const ShortClip& clip = shortClip();
  MisledRun run(keepOnePlace, 2);
  const FrameRecord record = run.reconstructor->process(lowered(clip.frames[1], 40));
  ASSERT_EQ(record.status, FrameStatus::kUnconfirmed) << record.reason;
  EXPECT_NE(record.reason.find("do not determine"), std::string::npos) << record.reason;
  EXPECT_EQ(run.reconstructor->process(clip.frames[2]).status, FrameStatus::kFused);
}

/// The scope hardly moves between two frames, and the model agrees with the second one.
TEST(DoubtfulPose, IsTheLastOneWhereMatchesDetermineNone) {
  const ShortClip& clip = shortClip();
  for (const Misled mislead : {keepOnePlace, dropAll}) {
    MisledRun run(mislead, 1);
    const FrameRecord record = run.reconstructor->process(clip.frames[1]);
    ASSERT_EQ(record.status, FrameStatus::kFused) << record.reason;
    EXPECT_EQ(run.calls, 1) << "it is not sought in the whole image";
    EXPECT_EQ(record.reason, "");
    EXPECT_FALSE(record.pose.found);
    EXPECT_EQ(record.world_from_left.matrix(), Eigen::Matrix4d::Identity());
    EXPECT_GE(record.evidence.view.agreement(), GateOptions::kMinAssumedAgreement);
    EXPECT_LE(record.confidence(), 0.5);
    EXPECT_LT(trackErrorMm(record, clip.truth[1]), 0.5);
    const FrameRecord next = run.reconstructor->process(clip.frames[2]);
    EXPECT_EQ(next.status, FrameStatus::kFused);
    EXPECT_TRUE(next.pose.found);
    EXPECT_LT(trackErrorMm(next, clip.truth[2]), 0.5);
  }
}

// The tissue is in view, and is not where the model would be seen.
TEST(DoubtfulPose, IsNotTheLastOneIfTheScopeMoved) {
  const ShortClip& clip = shortClip();
  MisledRun run(dropAll, 2);
  const FrameRecord record = run.reconstructor->process(lowered(clip.frames[1], 40));
  EXPECT_EQ(record.status, FrameStatus::kLost) << record.reason;
  const FrameRecord next = run.reconstructor->process(clip.frames[2]);
  EXPECT_EQ(next.status, FrameStatus::kRecovered) << "at the last pose again";
}

}  // namespace
}  // namespace softscope::test
