// tests/cuda/fusion_passes_test.cpp: the kernels of stage 7, run on the host in shuffled orders,
// update the model as the CPU does.
#include <gtest/gtest.h>

#include "cuda/comparison/comparison_run.h"
#include "cuda/frame/survey_run.h"
#include "cuda/fusion/fusion_run.h"
#include "fusion_cases.h"
#include "host_machine.h"

namespace softscope::test {
namespace {

class FusionPasses : public testing::TestWithParam<ComparisonCase> {};

TEST_P(FusionPasses, UpdateTheModelAsTheCpuDoesInAnyOrderOfThreads) {
  const FusionScene scene(GetParam());
  CpuModelUpdater cpu;
  const UpdatedModel first = scene.begin(&cpu), second = scene.goOn(&cpu);
  scene.expectEveryFate(second);
  for (const unsigned seed : {1U, 77U}) {
    cuda::FusionRun<HostMachine> kernels(FusionScene::camera(), seed);
    expectSameUpdate(scene.begin(&kernels), first);
    expectSameUpdate(scene.goOn(&kernels), second);
    expectSameUpdate(scene.goOn(&kernels), second);  // nothing is left of another frame
  }
}

/// The kernels compare and update one model in one place; apart, each takes it from the host anew.
TEST_P(FusionPasses, FindTheModelWhereOtherStagesLeftIt) {
  const FusionScene scene(GetParam());
  cuda::ComparisonRun<HostMachine> comparer_apart(FusionScene::camera(), 3U);
  CpuModelUpdater cpu;
  const UpdatedModel expected = scene.follow(&comparer_apart, &cpu);
  const auto home = std::make_shared<cuda::ModelHome<HostMachine>>();
  const auto frames = std::make_shared<cuda::SharedFrames>();
  const std::shared_ptr<const cuda::SharedRasters> rasters(frames, &frames->at_hand);
  cuda::ComparisonRun<HostMachine> comparer(FusionScene::camera(), 4U);
  cuda::FusionRun<HostMachine> kernels(FusionScene::camera(), 5U);
  comparer.share(home);
  comparer.share(rasters);
  kernels.share(home);
  kernels.share(rasters);
  expectSameUpdate(scene.follow(&comparer, &kernels), expected);
  cuda::SurveyRun<HostMachine> survey(FusionScene::camera(), frames, 6U);
  expectSameUpdate(scene.follow(&comparer, &kernels, &survey), expected);
  EXPECT_NE(rasters->depth_mm, nullptr);
}

INSTANTIATE_TEST_SUITE_P(Cuda, FusionPasses, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

TEST(FusionCrowd, IsThinnedAsTheCpuDoes) {
  const FusionScene scene(comparisonCases().front());
  CpuModelUpdater cpu;
  const UpdatedModel expected = thinCrowd(scene, &cpu);
  EXPECT_LT(expected.summary.index_map.new_count,
            static_cast<std::int32_t>(expected.summary.index_map.new_of_old.size()) - 2900);
  cuda::FusionRun<HostMachine> kernels(FusionScene::camera(), 5U);
  expectSameUpdate(thinCrowd(scene, &kernels), expected);
}

}  // namespace
}  // namespace softscope::test
