// cuda/device/device_info.h: which GPUs this machine has, or why there is none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace softscope::cuda {

/// One GPU, as its driver describes it.
struct Device {
  std::string name;
  int capability_major = 0;  // 9 of compute capability 9.0
  int capability_minor = 0;
  int multiprocessors = 0;
  std::uint64_t memory_bytes = 0;
  std::string problem;  // why this build's kernels don't run on it; empty: they do
};

/// CUDA's facts about this machine.
struct DeviceInfo {
  std::string runtime_version;  // of the toolkit softscope was built with: "13.0"; empty: CPU only
  std::string driver_version;   // newest CUDA that the driver supports; empty: no driver
  std::vector<Device> devices;
  std::string why_none;  // one line, empty if there are devices
};

/// Asks the driver. Without a driver or a GPU the answer is `why_none`, never a throw.
DeviceInfo queryDevices();

}  // namespace softscope::cuda
