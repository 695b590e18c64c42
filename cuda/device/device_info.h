// cuda/device/device_info.h: GPUs of this machine, or the reason for none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace softscope::cuda {

/// GPU as described by its driver.
struct Device {
  std::string name;
  int capability_major = 0;  // 9 of compute capability 9.0
  int capability_minor = 0;
  int multiprocessors = 0;
  std::uint64_t memory_bytes = 0;
  std::string problem;  // why kernels of this build cannot run; empty: they can
};

/// CUDA versions and devices of this machine.
struct DeviceInfo {
  std::string runtime_version;  // of the toolkit softscope was built with: "13.0"; empty: CPU only
  std::string driver_version;   // newest CUDA that the driver supports; empty: no driver
  std::vector<Device> devices;
  std::string why_none;  // one line, empty if there are devices
};

/// Queries the driver. Without a driver or GPU `why_none` is set; never throws.
DeviceInfo queryDevices();

}  // namespace softscope::cuda
