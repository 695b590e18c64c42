// cuda/device/device_machine.cuh: the first device with a stream of its own, as WarpRun and PoseRun
// use it.
#pragma once

#include "cuda/device/device_executor.cuh"
#include "cuda/device/device_stream.h"
#include "cuda/device/event_clock.h"

namespace softscope::cuda {

class DeviceMachine {
 public:
  using Memory = DeviceMemory;
  using Pinned = PinnedMemory;
  using Executor = DeviceExecutor<EventClock>;

  DeviceMachine() : executor_(stream_, nullptr) {}
  DeviceMachine(const DeviceMachine&) = delete;
  DeviceMachine& operator=(const DeviceMachine&) = delete;
  ~DeviceMachine() { cudaStreamSynchronize(stream_); }
  Executor& executor() { return executor_; }
  void toDevice(void* to, const void* from, std::size_t bytes) const {
    stream_.toDevice(to, from, bytes);
  }
  void fromDevice(void* to, const void* from, std::size_t bytes) const {
    stream_.fromDevice(to, from, bytes);
  }
  void wait() const { stream_.wait(); }

 private:
  Stream stream_;
  Executor executor_;
};

}  // namespace softscope::cuda
