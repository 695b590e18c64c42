// cuda/device/device_executor.cuh: launch of kernel bodies on a stream.
#pragma once

#include <cuda_runtime.h>

#include "cuda/device/device_memory.h"
#include "cuda/device/host_executor.h"
#include "cuda/device/kernel.h"

namespace softscope::cuda {

template <int kPhase, class Kernel>
__device__ __forceinline__ void runPhasesFrom(const Kernel& kernel, const Place& at,
                                              typename Kernel::Shared& shared,
                                              typename Kernel::Local& local) {
  kernel.template run<kPhase>(at, shared, local);
  if constexpr (kPhase + 1 < Kernel::kPhases) {
    __syncthreads();
    runPhasesFrom<kPhase + 1>(kernel, at, shared, local);
  }
}

template <class Kernel>
__global__ void __launch_bounds__(Kernel::kThreads)
    bodyKernel(const __grid_constant__ Kernel kernel) {
  static_assert(sizeof(typename Kernel::Shared) <= 48 * 1024, "every GPU has that much");
  __shared__ typename Kernel::Shared shared;
  typename Kernel::Local local;
  Place at{static_cast<int>(blockIdx.x),
           static_cast<int>(blockIdx.y),
           static_cast<int>(blockIdx.z),
           static_cast<int>(threadIdx.x),
           0,
           {static_cast<int>(gridDim.x), static_cast<int>(gridDim.y), static_cast<int>(gridDim.z)}};
  const int repeats = RepeatsOf<Kernel>::of(kernel, at);
  for (; at.repeat < repeats; ++at.repeat) {
    if (at.repeat > 0) {
      __syncthreads();
      if (EndOf<Kernel>::isOver(kernel, shared)) break;
    }
    runPhasesFrom<0>(kernel, at, shared, local);
  }
}

/// Launches on one stream; with `clock`, records an event at the end of each stage.
template <class Clock>
class DeviceExecutor {
 public:
  DeviceExecutor(cudaStream_t stream, Clock* clock) : stream_(stream), clock_(clock) {}

  template <class Kernel>
  void launch(const char* name, const Kernel& kernel, Grid grid) {
    if (grid.x <= 0 || grid.y <= 0 || grid.z <= 0) return;
    const dim3 blocks(static_cast<unsigned>(grid.x), static_cast<unsigned>(grid.y),
                      static_cast<unsigned>(grid.z));
    bodyKernel<<<blocks, Kernel::kThreads, 0, stream_>>>(kernel);
    check(cudaGetLastError(), name);
  }
  void mark(const char* stage) {
    if (clock_ != nullptr) clock_->mark(stage, stream_);
  }

 private:
  cudaStream_t stream_;
  Clock* clock_;
};

}  // namespace softscope::cuda
