// tests/pipeline/maps_test.cpp: places that the first model lacks, on a clip whose truth is known.
#include <gtest/gtest.h>

#include "core/error.h"
#include "pipeline/cpu_backend.h"
#include "pipeline/reconstructor.h"
#include "short_clip.h"

namespace softscope::test {
namespace {

/// Frames 1 to 5, and back.
const Frame& toAndFro(const ShortClip& clip, int i) {
  return clip.frames[static_cast<std::size_t>(1 + (i % 8 < 4 ? i % 8 : 8 - i % 8))];
}

/// Processes frames as `shown` shows them until one begins another map; false if none does.
template <class Shown>
bool beginsAnotherMap(const ShortClip& clip, Reconstructor& reconstructor, const Shown& shown) {
  for (int i = 0; i < 15; ++i) {
    const FrameRecord record = reconstructor.process(shown(toAndFro(clip, i)));
    if (record.status == FrameStatus::kStarted) return record.map == 1;
    EXPECT_EQ(record.status, FrameStatus::kLost) << record.reason;
  }
  return false;
}

// Lost for long, the other place gets a model of its own; the first one is found again.
TEST(ReconstructorMaps, BeginsAnotherMapElsewhereAndReturnsToTheFirst) {
  const ShortClip& clip = shortClip();
  Reconstructor reconstructor = reconstructorOf(clip, smallOptions());
  reconstructor.track(clip.seeds);
  for (int i = 0; i < 2; ++i) reconstructor.process(clip.frames[static_cast<std::size_t>(i)]);
  ASSERT_TRUE(beginsAnotherMap(clip, reconstructor, elsewhere));
  for (int i = 0; i < 6; ++i) {
    const FrameRecord there = reconstructor.process(elsewhere(clip.frames[std::size_t(i)]));
    EXPECT_EQ(there.status, FrameStatus::kFused) << there.reason;
    EXPECT_EQ(there.map, 1);
    EXPECT_LE(there.confidence(), 0.5) << "its pose in the first world is unknown";
    ASSERT_EQ(there.tracked.size(), clip.seeds.size());
    for (const TrackedPosition& point : there.tracked) EXPECT_FALSE(point.visible);
  }
  const FrameRecord back = reconstructor.process(clip.frames[2]);
  EXPECT_EQ(back.status, FrameStatus::kRecovered) << back.reason;
  EXPECT_EQ(back.map, 0);
  EXPECT_FALSE(back.join);
  EXPECT_LT(trackErrorMm(back, clip.truth[2]), 0.5);
  EXPECT_EQ(reconstructor.state().others.size(), 1u);
}

/// Only columns from `begin` to `end` are tissue.
Frame columnsOf(Frame frame, int begin, int end) {
  frame.mask = Mask(240, 180, 255);
  for (int v = 0; v < 180; ++v)
    for (int u = begin; u < end; ++u) frame.mask.at(u, v) = 0;
  return frame;
}

// A map of the left half, one of the right half; a frame that shows both makes them one.
TEST(ReconstructorMaps, JoinsMapsThatOverlap) {
  const ShortClip& clip = shortClip();
  Reconstructor reconstructor = reconstructorOf(clip, smallOptions());
  for (const Frame& frame : clip.frames) reconstructor.process(columnsOf(frame, 0, 130));
  const std::size_t left = reconstructor.model().model.size();
  ASSERT_TRUE(beginsAnotherMap(clip, reconstructor,
                               [](const Frame& frame) { return columnsOf(frame, 150, 240); }));
  FrameRecord record;
  for (int i = 0; i < 6; ++i)
    record = reconstructor.process(columnsOf(toAndFro(clip, i), 150, 240));
  EXPECT_EQ(record.map, 1);
  const std::size_t right = reconstructor.model().model.size();
  int at = 0;
  for (; at < 6 && !record.join; ++at) record = reconstructor.process(toAndFro(clip, at));
  ASSERT_TRUE(record.join) << record.reason;
  EXPECT_EQ(record.join->from, 1);
  EXPECT_EQ(record.join->into, 0);
  EXPECT_EQ(record.map, 0);
  EXPECT_TRUE(reconstructor.state().others.empty());
  const SimulatedFrame& truth = clip.truth[std::size_t(toAndFro(clip, at - 1).index)];
  const Eigen::Isometry3d off = record.world_from_left.inverse() * truth.pose.world_from_left;
  EXPECT_LT(off.translation().norm(), 1.5);
  EXPECT_GT(reconstructor.model().model.size(), left + right / 2);
  EXPECT_LT(reconstructor.model().model.size(), 2 * (left + right));
  record = reconstructor.process(toAndFro(clip, at));
  EXPECT_EQ(record.status, FrameStatus::kFused) << record.reason;
  EXPECT_GT(record.confidence(), 0.5);
}

/// A device that is lost after some matches; negative: never.
class FailingMatches : public MatchStage {
 public:
  FailingMatches(std::unique_ptr<MatchStage> stage, int* until_failure)
      : stage_(std::move(stage)), until_failure_(until_failure) {}
  ModelMatches match(const PointModel& model, const Eigen::Isometry3d& viewed_from,
                     const GrayImage& seen_gray, const MatchPicture& live,
                     const MeasuredFrame& frame, StageClock* clock) override {
    if ((*until_failure_)-- == 0) throw BackendError("CUDA: the device is lost");
    return stage_->match(model, viewed_from, seen_gray, live, frame, clock);
  }

 private:
  std::unique_ptr<MatchStage> stage_;
  int* until_failure_;
};

TEST(ReconstructorMaps, StayAsTheyWereWhereTheDeviceFailsInTheOther) {
  const ShortClip& clip = shortClip();
  const ReconstructionOptions options = smallOptions();
  int until_failure = -1;
  BackendParts parts;
  parts.makeMatching = [&](const ReconstructionOptions& all, const RectifiedRig& rig) {
    return std::make_unique<FailingMatches>(makeCpuMatchStage(all, rig), &until_failure);
  };
  Reconstructor reconstructor(makeCpuBackend(clip.calibration, options, parts), options);
  for (const Frame& frame : clip.frames) reconstructor.process(columnsOf(frame, 0, 130));
  ASSERT_TRUE(beginsAnotherMap(clip, reconstructor,
                               [](const Frame& frame) { return columnsOf(frame, 150, 240); }));
  until_failure = 1;  // that with the second map
  const FrameRecord record = reconstructor.process(toAndFro(clip, 0));
  EXPECT_EQ(record.status, FrameStatus::kFused) << record.reason;
  EXPECT_EQ(record.map, 1);
  EXPECT_FALSE(record.join);
  ASSERT_EQ(reconstructor.state().others.size(), 1u);
  EXPECT_EQ(reconstructor.state().others[0].scope.map, 0);
  bool joined = false;
  for (int i = 1; i < 6 && !joined; ++i)
    joined = reconstructor.process(toAndFro(clip, i)).join.has_value();
  EXPECT_TRUE(joined);
}

// Gauze over the lens has texture and depth, but is no place.
TEST(ReconstructorMaps, BeginsNoMapOfWhatIsNotRed) {
  const ShortClip& clip = shortClip();
  Reconstructor reconstructor = reconstructorOf(clip, smallOptions());
  for (int i = 0; i < 2; ++i) reconstructor.process(clip.frames[static_cast<std::size_t>(i)]);
  const auto grey = [](const Frame& frame) {
    Frame gauze = elsewhere(frame);
    for (ColourImage* picture : {&gauze.pair.left, &gauze.pair.right})
      for (Rgb8& pixel : picture->values) {
        const std::uint8_t level = toGray(pixel);
        pixel = {level, level, level};
      }
    return gauze;
  };
  for (int i = 0; i < 12; ++i)
    EXPECT_EQ(reconstructor.process(grey(toAndFro(clip, i))).status, FrameStatus::kLost);
}

}  // namespace
}  // namespace softscope::test
