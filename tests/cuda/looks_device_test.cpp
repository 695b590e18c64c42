// tests/cuda/looks_device_test.cpp: the GPU finds first looks as the CPU does.
#include <gtest/gtest.h>

#include "cuda/device/device_info.h"
#include "looks_cases.h"

namespace softscope::test {
namespace {

TEST(LooksOnDevice, AreThoseOfTheCpu) {
  const cuda::DeviceInfo info = cuda::queryDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;
  const auto device = cuda::makeLookFinder();
  for (unsigned frame = 0; frame < 4; ++frame) {
    const LookCases cases(frame);
    device->forget();
    expectSameLooks(cases, cases.ignore, device.get());
    expectSameLooks(cases, Mask(), device.get());
  }
}

}  // namespace
}  // namespace softscope::test
