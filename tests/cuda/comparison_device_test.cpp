// tests/cuda/comparison_device_test.cpp: model and frame compared on the GPU, as on the CPU.
#include <gtest/gtest.h>

#include "comparison_cases.h"
#include "cuda/comparison/comparison.h"
#include "cuda/device/device_info.h"

namespace softscope::test {
namespace {

class ComparisonOnDevice : public testing::TestWithParam<ComparisonCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(ComparisonOnDevice, FindsWhatTheCpuFindsFrameAfterFrame) {
  const ComparisonScene scene(GetParam()), other(comparisonCases()[1]);
  CpuFrameComparer cpu;
  const auto device = cuda::makeFrameComparer(ComparisonScene::camera());
  const ComparisonScene::Found first = scene.compareWith(device.get());
  scene.expectSame(first, scene.compareWith(&cpu));
  other.compareWith(device.get());
  scene.expectEqual(scene.compareWith(device.get()), first);
}

INSTANTIATE_TEST_SUITE_P(Cuda, ComparisonOnDevice, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope::test
