// tests/cuda/fusion_passes_test.cpp: kernels of the fusion formulas, run on the host in shuffled
// orders, update the model as the CPU does.
#include <gtest/gtest.h>

#include "fusion_cases.h"
#include "host_machine.h"

namespace softscope::test {
namespace {

class FusionPasses : public testing::TestWithParam<ComparisonCase> {};

TEST_P(FusionPasses, UpdateTheModelAsTheCpuDoesInAnyOrderOfThreads) {
  const FusionScene scene(GetParam());
  scene.expectSame(FusionRun<HostMachine>(1U).update(scene.inputs()));
  scene.expectSame(FusionRun<HostMachine>(77U).update(scene.inputs()));
}

INSTANTIATE_TEST_SUITE_P(Cuda, FusionPasses, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope::test
