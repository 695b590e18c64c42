// cuda/device/device_memory.h: owned memory of the device, pinned memory of the host, and checked
// calls.
#pragma once

#include <cuda_runtime_api.h>

#include <cstddef>
#include <string>
#include <utility>

#include "core/error.h"

namespace softscope::cuda {

/// Throws BackendError with the call, the reason of CUDA and advice.
inline void check(cudaError_t status, const char* call) {
  if (status == cudaSuccess) return;
  std::string text = std::string("CUDA: ") + call + ": " + cudaGetErrorString(status);
  if (status == cudaErrorMemoryAllocation)
    text += ". End other programs on this GPU (nvidia-smi lists them), or take smaller images";
  else if (status == cudaErrorInsufficientDriver || status == cudaErrorNoDevice)
    text += ". `softscope doctor` says what this machine has; the CPU needs no GPU";
  throw BackendError(text);
}

/// One allocation, released by the destructor.
template <cudaError_t (*kAllocate)(void**, std::size_t), cudaError_t (*kFree)(void*)>
class OwnedMemory {
 public:
  OwnedMemory() = default;
  OwnedMemory(std::size_t bytes, const char* what) : bytes_(bytes) {
    if (bytes > 0) check(kAllocate(&data_, bytes), what);
  }
  OwnedMemory(OwnedMemory&& other) noexcept { swap(other); }
  OwnedMemory& operator=(OwnedMemory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~OwnedMemory() {
    if (data_ != nullptr) kFree(data_);
  }
  void* data() const { return data_; }
  std::size_t bytes() const { return bytes_; }

 private:
  void swap(OwnedMemory& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
  }
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

inline cudaError_t allocateDevice(void** data, std::size_t bytes) {
  return cudaMalloc(data, bytes);
}
inline cudaError_t allocatePinned(void** data, std::size_t bytes) {
  return cudaMallocHost(data, bytes);
}
using DeviceMemory = OwnedMemory<allocateDevice, cudaFree>;
using PinnedMemory = OwnedMemory<allocatePinned, cudaFreeHost>;

}  // namespace softscope::cuda
