// tests/pipeline/inactive_loop_test.cpp: inactive points over the whole loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/warp_graph.h"
#include "deform/solver/local_solver.h"
#include "pipeline/backends.h"
#include "pipeline/checkpoint.h"
#include "pipeline/cpu_backend.h"
#include "pipeline/model/active_region.h"
#include "short_clip.h"

namespace softscope::test {
namespace {

/// More than LocalRule::kWholeUpTo after a few frames.
ReconstructionOptions nodesForASweep() {
  ReconstructionOptions options = smallOptions();
  options.graph.node_spacing_mm = 0.85;
  return options;
}

/// Numbers of points, and all of them, after each frame.
struct Sweep {
  std::vector<std::size_t> active, inactive;
  std::vector<PointModel> all;
  std::vector<FrameRecord> records;
};

void follow(Reconstructor& reconstructor, std::size_t begin, std::size_t end, Sweep* made) {
  const std::vector<Frame>& frames = clipWithASweep().frames;
  for (std::size_t i = begin; i < end; ++i) {
    made->records.push_back(reconstructor.process(frames[i], framesAfter(frames, i)));
    EXPECT_TRUE(made->records.back().fused()) << i << ": " << made->records.back().reason;
    ModelState whole = reconstructor.model();
    made->active.push_back(whole.model.size());
    made->inactive.push_back(countInactive(whole));
    activateAll(&whole);
    made->all.push_back(whole.model);
  }
}

/// With some tracked points, which go out of view.
Sweep sweepAheadFrom(int threads) {
  BackendParts parts;
  parts.ahead_from_threads = threads;
  const ShortClip& clip = clipWithASweep();
  Reconstructor reconstructor{makeCpuBackend(clip.calibration, nodesForASweep(), parts),
                              nodesForASweep()};
  reconstructor.track(clip.seeds);
  Sweep made;
  follow(reconstructor, 0, clip.frames.size(), &made);
  return made;
}

/// By the processor, nothing ahead.
const Sweep& sweepInTurn() {
  static const Sweep made = sweepAheadFrom(1000);
  return made;
}

TEST(InactiveLoop, DeactivatesOnTheWayAndActivatesOnTheWayBack) {
  const Sweep& sweep = sweepInTurn();
  std::size_t deactivated = 0, activated = 0;
  for (std::size_t i = 1; i < sweep.records.size(); ++i) {
    const FrameRecord& record = sweep.records[i];
    const std::size_t before = sweep.inactive[i - 1], now = sweep.inactive[i];
    EXPECT_EQ(record.points, static_cast<int>(sweep.active[i] + now));
    (now > before ? deactivated : activated) += std::max(now, before) - std::min(now, before);
    // What comes back into view is known there: tissue that is measured twice would be a tenth.
    if (now < before) EXPECT_LT(record.fusion.inserted, record.points / 100) << i;
  }
  const std::size_t first = sweep.active.front();
  EXPECT_GT(deactivated, first / 2);
  EXPECT_GT(activated, first / 4);
}

TEST(InactiveLoop, KeepsModelAndTrackedPointsOnTheTissue) {
  const FrameRecord& last = sweepInTurn().records.back();
  const SimulatedFrame& truth = clipWithASweep().truth.back();
  int count = 0;
  double sum_mm = 0;
  for (const TrackedPosition& point : last.tracked) {
    if (!point.position_mm.allFinite()) continue;
    ++count;
    sum_mm += (last.world_from_left.inverse() * point.position_mm -
               truth.pose.world_from_left.inverse() *
                   truth.tracks_world_mm[static_cast<std::size_t>(point.id)])
                  .norm();
  }
  EXPECT_GT(count, 30);
  EXPECT_LT(sum_mm / count, 0.3);
}

TEST(InactiveLoop, IsTheSameWhereStagesWorkAhead) {
  const Sweep ahead = sweepAheadFrom(1);
  EXPECT_EQ(ahead.inactive, sweepInTurn().inactive);
  for (std::size_t i = 0; i < ahead.all.size(); ++i)
    expectModel(sweepInTurn().all[i], "cpu", ahead.all[i]);
}

class InactiveLoopOn : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string why = cudaUnavailableReason(); GetParam() == "cuda" && !why.empty())
      GTEST_SKIP() << why;
  }
  static Reconstructor make() {
    return {makeBackend(GetParam(), clipWithASweep().calibration, nodesForASweep()).part,
            nodesForASweep()};
  }
};

TEST_P(InactiveLoopOn, GoesOnAcrossCheckpoints) {
  const ShortClip& clip = clipWithASweep();
  Sweep at_once;
  Reconstructor whole = make();
  whole.track(clip.seeds);
  follow(whole, 0, clip.frames.size(), &at_once);

  std::string stopped;
  constexpr std::size_t kFrames = 9;
  for (std::size_t begin = 0; begin < clip.frames.size(); begin += kFrames) {
    const std::size_t end = std::min(begin + kFrames, clip.frames.size());
    Reconstructor part = make();
    if (begin == 0)
      part.track(clip.seeds);
    else
      part.restore(parseCheckpoint(stopped, "a").state);
    Sweep made;
    follow(part, begin, end, &made);
    stopped = checkpointBytes({"same", static_cast<int>(end), part.state()});
    EXPECT_EQ(made.inactive.back(), at_once.inactive[end - 1]);
    EXPECT_TRUE(bytesOf(made.all.back()) == bytesOf(at_once.all[end - 1])) << end;
  }
}

/// Differences in the last digits grow over this clip until one of its few matches is another: the
/// back ends are compared from the same state.
TEST_P(InactiveLoopOn, GoesOnLikeTheCpu) {
  Reconstructor on_cpu = reconstructorOf(clipWithASweep(), nodesForASweep());
  on_cpu.track(clipWithASweep().seeds);
  Sweep expected;
  follow(on_cpu, 0, 15, &expected);  // then some points become inactive, and active again
  for (std::size_t i = 15; i < clipWithASweep().frames.size(); ++i) {
    const std::string before = checkpointBytes({"same", static_cast<int>(i), on_cpu.state()});
    follow(on_cpu, i, i + 1, &expected);
    if (i % 3 != 0 && expected.inactive[i] == expected.inactive[i - 1]) continue;
    Reconstructor part = make();
    part.restore(parseCheckpoint(before, "a").state);
    Sweep made;
    follow(part, i, i + 1, &made);
    EXPECT_EQ(made.inactive.back(), expected.inactive[i]);
    expectModel(expected.all[i], GetParam(), made.all.back());
  }
}

INSTANTIATE_TEST_SUITE_P(Built, InactiveLoopOn, testing::ValuesIn(builtBackends()),
                         [](const auto& each) { return each.param; });

/// After a loss the model is sought from anywhere: all of it is active then.
TEST(InactiveLoop, IsFoundAgainWhereItWasInactive) {
  const ShortClip& clip = clipWithASweep();
  Reconstructor reconstructor = reconstructorOf(clip, nodesForASweep());
  Sweep made;
  constexpr std::size_t turn = 23;
  follow(reconstructor, 0, turn, &made);
  ASSERT_GT(made.inactive.back(), 0u);
  const FrameRecord lost = reconstructor.process(flatFrame(clip, static_cast<int>(turn), 90));
  EXPECT_FALSE(lost.fused());
  bool found = false;
  for (int k = 0; k < 4 && !found; ++k) found = reconstructor.process(clip.frames.front()).fused();
  EXPECT_TRUE(found);
  EXPECT_LT(reconstructor.model().model.size() + countInactive(reconstructor.model()),
            made.active.back() + made.inactive.back() + made.active.front() / 10);
}

}  // namespace
}  // namespace softscope::test
