// tests/cuda/surface_device_test.cpp: the GPU finds the model's surface as the CPU does.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "cuda/surface/surface.h"
#include "surface_cases.h"

namespace softscope::test {
namespace {

TEST(SurfaceOnDevice, IsThatOfTheCpu) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const auto device = cuda::makeSurfaceSearch();
  const SurfaceScene scene, crowded(2000);
  for (int frame = 0; frame < 3; ++frame) {
    expectSameSurface(scene, device.get());
    expectSameSurface(crowded, device.get());
  }
}

}  // namespace
}  // namespace softscope::test
