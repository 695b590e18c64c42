// tests/cuda/device_info_test.cpp: the GPU query answers on every machine, with GPUs or a reason.
#include <gtest/gtest.h>

#include "pipeline/backends.h"

namespace softscope {
namespace {

TEST(DeviceInfo, GivesDevicesOrTheReasonForNone) {
  const cuda::DeviceInfo info = cudaDevices();

  EXPECT_EQ(info.devices.empty(), !info.why_none.empty());
  EXPECT_EQ(info.why_none.find('\n'), std::string::npos);  // one line, to be printed as it is
}

TEST(DeviceInfo, TheReasonNamesWhatIsMissing) {
  const cuda::DeviceInfo info = cudaDevices();
  if (!info.devices.empty()) GTEST_SKIP() << "this machine has a GPU: there is no reason to give";

  const bool cpu_only_build = info.runtime_version.empty();
  const std::string named = cpu_only_build ? "this build has no CUDA" : "driver";
  EXPECT_NE(info.why_none.find(named), std::string::npos) << info.why_none;
}

TEST(DeviceInfo, DescribesEachGpuAndRunsOurCodeOnIt) {
  const cuda::DeviceInfo info = cudaDevices();
  if (info.devices.empty()) GTEST_SKIP() << info.why_none;

  for (const cuda::Device& device : info.devices) {
    EXPECT_FALSE(device.name.empty());
    EXPECT_GE(device.capability_major * 10 + device.capability_minor, 75) << "oldest we build for";
    EXPECT_GT(device.memory_bytes, std::uint64_t{1} << 30) << "no such GPU has less than 1 GiB";
    EXPECT_GT(device.multiprocessors, 0);
    EXPECT_EQ(device.problem, "") << device.name;
  }
}

}  // namespace
}  // namespace softscope
