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

/// Active and inactive points after each frame.
struct Sweep {
  std::vector<PointModel> active, inactive;
  std::vector<FrameRecord> records;
};

void follow(Reconstructor& reconstructor, std::size_t begin, std::size_t end, Sweep* made) {
  const std::vector<Frame>& frames = clipWithASweep().frames;
  for (std::size_t i = begin; i < end; ++i) {
    made->records.push_back(reconstructor.process(frames[i], framesAfter(frames, i)));
    EXPECT_TRUE(made->records.back().fused()) << i << ": " << made->records.back().reason;
    made->active.push_back(reconstructor.model().model);
    made->inactive.push_back(reconstructor.model().inactive.points);
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
    const std::size_t before = sweep.inactive[i - 1].size(), now = sweep.inactive[i].size();
    EXPECT_EQ(record.points, static_cast<int>(sweep.active[i].size() + now));
    (now > before ? deactivated : activated) += std::max(now, before) - std::min(now, before);
    // What comes back into view is known there: tissue that is measured twice would be a tenth.
    if (now < before) EXPECT_LT(record.fusion.inserted, record.points / 100) << i;
  }
  const std::size_t first = sweep.active.front().size();
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
  for (std::size_t i = 0; i < ahead.active.size(); ++i) {
    expectModel(sweepInTurn().active[i], "cpu", ahead.active[i]);
    expectModel(sweepInTurn().inactive[i], "cpu", ahead.inactive[i]);
  }
}

class InactiveLoopOn : public testing::TestWithParam<std::string> {};

TEST_P(InactiveLoopOn, GoesOnAcrossCheckpoints) {
  if (const std::string why = cudaUnavailableReason(); GetParam() == "cuda" && !why.empty())
    GTEST_SKIP() << why;
  const ShortClip& clip = clipWithASweep();
  std::string stopped;
  constexpr std::size_t kFrames = 5;
  for (std::size_t begin = 0; begin < clip.frames.size(); begin += kFrames) {
    const std::size_t end = std::min(begin + kFrames, clip.frames.size());
    Reconstructor part{makeBackend(GetParam(), clip.calibration, nodesForASweep()).part,
                       nodesForASweep()};
    if (begin == 0)
      part.track(clip.seeds);
    else
      part.restore(parseCheckpoint(stopped, "a").state);
    Sweep made;
    follow(part, begin, end, &made);
    stopped = checkpointBytes({"same", static_cast<int>(end), part.state()});
    expectModel(sweepInTurn().active[end - 1], GetParam(), made.active.back());
    expectModel(sweepInTurn().inactive[end - 1], GetParam(), made.inactive.back());
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
  ASSERT_GT(made.inactive.back().size(), 0u);
  const FrameRecord lost = reconstructor.process(flatFrame(clip, static_cast<int>(turn), 90));
  EXPECT_FALSE(lost.fused());
  bool found = false;
  for (int k = 0; k < 4 && !found; ++k) found = reconstructor.process(clip.frames.front()).fused();
  EXPECT_TRUE(found);
  EXPECT_LT(
      reconstructor.backend().state().model.size(),
      made.active.back().size() + made.inactive.back().size() + made.active.back().size() / 10);
}

}  // namespace
}  // namespace softscope::test
