// tests/cuda/warp_device_test.cpp: the warp found on the GPU has the CPU's energy.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "cuda/warp/warp.h"
#include "same_search.h"
#include "warp_cases.h"

namespace softscope {
namespace {

class WarpOnDevice : public testing::TestWithParam<test::WarpCase> {
 protected:
  void SetUp() override {
    const cuda::DeviceInfo info = cuda::queryDevices();
    if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  }
};

TEST_P(WarpOnDevice, HasTheCpusEnergyFrameAfterFrame) {
  const test::WarpScene scene(GetParam()), other(test::warpCases().front());
  const test::WarpScene::Found expected = scene.solve(scene.solverOnTheCpu().get());
  const auto solver = scene.local(makeDeformSolver(
      scene.options(),
      makeDeviceWarpSystem(scene.options(), cuda::makeWarpDevice(scene.weights()))));
  const test::WarpScene::Found first = scene.solve(solver.get());
  test::expectSameSearch(first.summary, expected.summary);
  EXPECT_LT(test::furthestApart(first.graph, expected.graph), 1e-6);
  other.solve(solver.get());
  EXPECT_EQ(test::furthestApart(first.graph, scene.solve(solver.get()).graph), 0);
}

INSTANTIATE_TEST_SUITE_P(Cuda, WarpOnDevice, testing::ValuesIn(test::warpCases()),
                         [](const auto& each) { return each.param.name; });

}  // namespace
}  // namespace softscope
