// tests/cuda/host_machine.h: runs kernels on the host, for WarpRun and PoseRun.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>

#include "cuda/device/host_executor.h"
#include "host_memory.h"

namespace softscope::test {

/// Memory and copies of the host in place of a device.
class HostMachine {
 public:
  using Executor = cuda::HostExecutor;
  class Memory {
   public:
    Memory() = default;
    Memory(std::size_t bytes, const char*)
        : memory_(std::make_unique<HostMemory>(bytes)), bytes_(bytes) {}
    void* data() const { return memory_ ? memory_->data() : nullptr; }
    std::size_t bytes() const { return bytes_; }

   private:
    std::unique_ptr<HostMemory> memory_;
    std::size_t bytes_ = 0;
  };
  using Pinned = Memory;

  explicit HostMachine(unsigned seed) : executor_(seed) {}
  Executor& executor() { return executor_; }
  void toDevice(void* to, const void* from, std::size_t bytes) const {
    std::memcpy(to, from, bytes);
  }
  void fromDevice(void* to, const void* from, std::size_t bytes) const {
    std::memcpy(to, from, bytes);
  }
  void wait() const {}

 private:
  Executor executor_;
};

}  // namespace softscope::test
