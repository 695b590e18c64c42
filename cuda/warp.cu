#include "cuda/device_executor.cuh"
#include "cuda/device_stream.h"
#include "cuda/event_clock.h"
#include "cuda/warp.h"
#include "cuda/warp_run.h"

namespace softscope::cuda {
namespace {

/// The first device, with a stream of its own.
class DeviceMachine {
 public:
  using Memory = DeviceMemory;
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

}  // namespace

std::unique_ptr<WarpDevice> makeWarpDevice(const WarpWeights& weights) {
  requireDevice();
  return std::make_unique<WarpRun<DeviceMachine>>(weights);
}

}  // namespace softscope::cuda
