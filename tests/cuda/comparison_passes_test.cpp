// tests/cuda/comparison_passes_test.cpp: the kernels that compare model and frame, run on the host
// in shuffled orders, find what the CPU finds.
#include <gtest/gtest.h>

#include "comparison_cases.h"
#include "cuda/comparison/comparison_run.h"
#include "host_machine.h"

namespace softscope::test {
namespace {

class ComparisonPasses : public testing::TestWithParam<ComparisonCase> {};

TEST_P(ComparisonPasses, FindWhatTheCpuFindsInAnyOrderOfThreads) {
  const ComparisonScene scene(GetParam()), other(comparisonCases()[1]);
  CpuFrameComparer cpu;
  const ComparisonScene::Found expected = scene.compareWith(&cpu);
  cuda::ComparisonRun<HostMachine> ordered(ComparisonScene::camera(), 1U);
  cuda::ComparisonRun<HostMachine> shuffled(ComparisonScene::camera(), 77U);
  const ComparisonScene::Found found = scene.compareWith(&ordered);
  scene.expectSame(found, expected);
  other.compareWith(&shuffled);  // nothing is left of another frame
  scene.expectEqual(scene.compareWith(&shuffled), found);
}

INSTANTIATE_TEST_SUITE_P(Cuda, ComparisonPasses, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope::test
