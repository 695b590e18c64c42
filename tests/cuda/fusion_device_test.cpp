// tests/cuda/fusion_device_test.cpp: the fusion formulas on the GPU give the CPU's model.
#include "fusion_device.h"

#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "fusion_cases.h"

namespace softscope::test {
namespace {

class FusionOnDevice : public testing::TestWithParam<ComparisonCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(FusionOnDevice, UpdatesTheModelAsTheCpuDoes) {
  const FusionScene scene(GetParam());
  scene.expectSame(fuseOnDevice(scene.inputs()));
}

INSTANTIATE_TEST_SUITE_P(Cuda, FusionOnDevice, testing::ValuesIn(comparisonCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope::test
