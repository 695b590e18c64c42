#include <cuda_runtime_api.h>

#include "cuda/device/device_info.h"

namespace softscope::cuda {
namespace {

// Never launched: the runtime checks its code to determine whether a device can run ours.
__global__ void probeKernel() {}

/// 13000 is "13.0", 12080 is "12.8".
std::string versionText(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

std::string reason(cudaError_t error) { return cudaGetErrorString(error); }

std::string problemOf(int index) {
  cudaFuncAttributes attributes{};
  cudaError_t error = cudaSetDevice(index);
  if (error == cudaSuccess) error = cudaFuncGetAttributes(&attributes, probeKernel);
  if (error == cudaErrorMemoryAllocation)
    return "other programs have taken its memory; end them (nvidia-smi lists them)";
  return error == cudaSuccess ? std::string() : reason(error);
}

Device describe(int index) {
  Device device;
  cudaDeviceProp found{};
  if (const cudaError_t error = cudaGetDeviceProperties(&found, index); error != cudaSuccess) {
    device.problem = reason(error);
    return device;
  }
  device.name = found.name;
  device.capability_major = found.major;
  device.capability_minor = found.minor;
  device.multiprocessors = found.multiProcessorCount;
  device.memory_bytes = found.totalGlobalMem;
  device.problem = problemOf(index);
  return device;
}

std::string unavailableReason(const DeviceInfo& info, cudaError_t error) {
  if (info.driver_version.empty())
    return "no NVIDIA driver answers: install one that speaks CUDA " + info.runtime_version +
           " or newer, and see whether nvidia-smi lists a GPU";
  if (error != cudaSuccess && error != cudaErrorNoDevice)
    return "the driver speaks CUDA " + info.driver_version + ", this build needs " +
           info.runtime_version + ": " + reason(error);
  return "the driver lists no GPU: see nvidia-smi and the variable CUDA_VISIBLE_DEVICES";
}

}  // namespace

DeviceInfo queryDevices() {
  DeviceInfo info;
  info.runtime_version = versionText(CUDART_VERSION);
  int driver_version = 0;
  if (cudaDriverGetVersion(&driver_version) == cudaSuccess && driver_version > 0)
    info.driver_version = versionText(driver_version);
  int count = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  for (int i = 0; error == cudaSuccess && i < count; ++i) info.devices.push_back(describe(i));
  if (info.devices.empty()) info.why_none = unavailableReason(info, error);
  return info;
}

}  // namespace softscope::cuda
