// tests/pipeline/large_graph_test.cpp: a graph of which a part lies out of view, over the whole
// loop.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "core/warp_graph.h"
#include "deform/solver/local_solver.h"
#include "pipeline/backends.h"
#include "pipeline/checkpoint.h"
#include "pipeline/cpu_backend.h"
#include "short_clip.h"

namespace softscope::test {
namespace {

ReconstructionOptions manyNodes() {
  ReconstructionOptions options = smallOptions();
  options.graph.node_spacing_mm = 1.2;
  return options;
}

/// The whole view, then about its right third for three frames, then the whole again. Nodes are
/// chosen in the second frame, again in the third, and kept in the fourth, which sees a little
/// less.
const std::vector<Frame>& partlyMasked() {
  static const std::vector<Frame> all = [] {
    std::vector<Frame> made = shortClip().frames;
    constexpr int kHiddenColumns[] = {0, 160, 140, 146, 0, 0};
    for (std::size_t i = 1; i < 4; ++i) {
      const ColourImage& left = made[i].pair.left;
      made[i].mask = Mask(left.width_px, left.height_px, 0);
      for (int v = 0; v < left.height_px; ++v)
        std::fill_n(made[i].mask.row(v), kHiddenColumns[i], std::uint8_t{255});
    }
    return made;
  }();
  return all;
}

/// Frames begin … end - 1, each with those after it.
void follow(Reconstructor& reconstructor, std::size_t begin, std::size_t end) {
  const std::vector<Frame>& frames = partlyMasked();
  for (std::size_t i = begin; i < end; ++i)
    EXPECT_TRUE(reconstructor.process(frames[i], framesAfter(frames, i)).fused()) << i;
}

Reconstructor aheadFrom(int threads) {
  BackendParts parts;
  parts.ahead_from_threads = threads;
  return {makeCpuBackend(shortClip().calibration, manyNodes(), parts), manyNodes()};
}

std::size_t nodesAfar(const Reconstructor& reconstructor) {
  const std::vector<std::uint8_t>& afar = reconstructor.model().graph.afar;
  return static_cast<std::size_t>(std::count(afar.begin(), afar.end(), 1));
}

/// After each frame, by the processor, nothing ahead.
const std::vector<PointModel>& modelsInTurn() {
  static const std::vector<PointModel> models = [] {
    Reconstructor reconstructor = aheadFrom(1000);
    std::vector<PointModel> made;
    for (std::size_t i = 0; i < partlyMasked().size(); ++i) {
      follow(reconstructor, i, i + 1);
      if (i > 0) EXPECT_GT(reconstructor.model().graph.size(), LocalRule::kWholeUpTo);
      EXPECT_EQ(nodesAfar(reconstructor) > 0, i >= 1 && i < 4) << i;
      made.push_back(reconstructor.model().model);
    }
    return made;
  }();
  return models;
}

TEST(LargeGraph, IsTheSameWhereStagesWorkAhead) {
  Reconstructor ahead = aheadFrom(1);
  for (std::size_t i = 0; i < partlyMasked().size(); ++i) {
    follow(ahead, i, i + 1);
    expectModel(modelsInTurn()[i], "cpu", ahead.model().model);
  }
}

class LargeGraphOn : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (const std::string why = cudaUnavailableReason(); GetParam() == "cuda" && !why.empty())
      GTEST_SKIP() << why;
  }
  static Reconstructor make() {
    return {makeBackend(GetParam(), shortClip().calibration, manyNodes()).part, manyNodes()};
  }
};

TEST_P(LargeGraphOn, GoesOnAcrossCheckpoints) {
  Reconstructor at_once = make();
  std::string stopped;
  for (std::size_t begin = 0; begin < partlyMasked().size(); begin += 2) {
    Reconstructor part = make();  // nodes become local, or no longer
    if (begin > 0) part.restore(parseCheckpoint(stopped, "a").state);
    for (Reconstructor* each : {&at_once, &part}) follow(*each, begin, begin + 2);
    stopped = checkpointBytes({"same", static_cast<int>(begin) + 2, part.state()});
    EXPECT_TRUE(bytesOf(part.model().model) == bytesOf(at_once.model().model)) << begin;
  }
}

/// From the same state: over several frames, differences in the last digits grow until a match is
/// another.
TEST_P(LargeGraphOn, GoesOnLikeTheCpu) {
  Reconstructor on_cpu = reconstructorOf(shortClip(), manyNodes());
  for (std::size_t i = 0; i < partlyMasked().size(); ++i) {
    Reconstructor part = make();
    if (i > 0)
      part.restore(
          parseCheckpoint(checkpointBytes({"same", static_cast<int>(i), on_cpu.state()}), "a")
              .state);
    for (Reconstructor* each : {&on_cpu, &part}) follow(*each, i, i + 1);
    expectModel(modelsInTurn()[i], GetParam(), part.model().model);
  }
}

INSTANTIATE_TEST_SUITE_P(Built, LargeGraphOn, testing::ValuesIn(builtBackends()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace softscope::test
